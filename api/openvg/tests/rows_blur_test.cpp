// Gaussian blurs beside the formula: within 1/255.

#include "api/openvg/tests/rows_fixture.hpp"

namespace vtm::openvg::testing {
namespace {

TEST_F(RowsTest, BlursAreGaussians) {
    constexpr int w = 150, h = 40;
    vgSeti(VG_FILTER_FORMAT_PREMULTIPLIED, VG_TRUE);
    const std::array<VGfloat, 4> fill{0.3f, 0.9f, 0.1f, 1};
    vgSetfv(VG_TILE_FILL_COLOR, 4, fill.data());
    const auto place = [](int i, int size, VGTilingMode mode) {
        const int tile = int(std::floor(double(i) / size)), rest = i - tile * size;
        return mode == VG_TILE_REPEAT    ? rest
               : mode == VG_TILE_REFLECT ? (tile & 1 ? size - 1 - rest : rest)
               : mode == VG_TILE_PAD     ? std::clamp(i, 0, size - 1)
               : tile == 0               ? i
                                         : -1;
    };
    for (const double deviation : {0.3, 2.0, 4.99, 5.0, 6.1, 11.0, 20.0, 60.0})
        for (const VGTilingMode mode : {VG_TILE_FILL, VG_TILE_PAD, VG_TILE_REPEAT, VG_TILE_REFLECT}) {
            // Stripes are harder than noise: black and white in places.
            TwinImage image(VG_sABGR_8888_PRE, w, h), result = image;
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    image.word(x, y) =
                        (x / 7 + y / 5) % 2 ? 0xffffff00 | unsigned(x) : 0xff000000 | unsigned(y);
            const VGImage src = uploaded(image), dst = newImage(image.name, w, h);
            vgGaussianBlur(dst, src, VGfloat(deviation), VGfloat(1.5 * deviation), mode);
            vgGetImageSubData(dst, result.words.data(), 4 * w, image.name, 0, 0, w, h);

            const auto weights = [](double s) {
                const int reach = int(std::ceil(6 * s));
                std::vector<double> g;
                double sum = 0;
                for (int i = -reach; i <= reach; ++i)
                    sum += g.emplace_back(std::exp(-0.5 * (i / s) * (i / s)));
                for (double& v : g)
                    v /= sum;
                return g;
            };
            const std::vector<double> across = weights(deviation), up = weights(1.5 * deviation);
            const auto sum = [&](const std::vector<double>& g, int at, int size, auto&& pixel) {
                glm::dvec4 total(0);
                for (std::size_t k = 0; k < g.size(); ++k) {
                    const int i = place(at + int(k) - int(g.size() / 2), size, mode);
                    total += g[k] * (i < 0 ? glm::dvec4(fill[0], fill[1], fill[2], fill[3]) : pixel(i));
                }
                return total;
            };
            std::vector<glm::dvec4> rows(std::size_t(w * h));
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    rows[std::size_t(y * w + x)] =
                        sum(across, x, w, [&](int i) { return glm::dvec4(image.color(i, y)); });
            int wrong = 0;
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    wrong += !testing::isNear(
                        image.format, result.word(x, y),
                        Color(sum(up, y, h, [&](int j) { return rows[std::size_t(j * w + x)]; })));
            EXPECT_EQ(wrong, 0) << deviation << " " << std::hex << mode;
            vgDestroyImage(src);
            vgDestroyImage(dst);
        }
}

}  // namespace
}  // namespace vtm::openvg::testing

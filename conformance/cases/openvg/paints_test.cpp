// Gradients and patterns pixel by pixel against the formulas of sections 9.3 and 9.4, under random affine
// matrices.

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "conformance/cases/openvg/support.hpp"

namespace vtm::cases::openvg {

namespace {

using glm::dvec2;
using Color = glm::dvec4;

/// Offsets that a step of the ramp, or a texel's border, may fall on either side of: not compared.
constexpr double nearStep = 1e-4;

class PaintsCase : public VgCase {
protected:
    PaintsCase() {
        // sRGB numbers as the paint has them.
        vgSeti(VG_BLEND_MODE, VG_BLEND_SRC);
        const VtmSurfaceFormat format{8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE};
        plain_ = vtmCreateSurface(side, side, &format);
        EXPECT_TRUE(vtmMakeCurrent(vtmGetCurrentContext(), plain_));
        all_ = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        vguRect(all_, -1000, -1000, 2000, 2000);
    }
    ~PaintsCase() override {
        vgDestroyPath(all_);
        vtmDestroySurface(plain_);
    }

    /// Draws with a paint whose unit is about `scale` pixels, and compares each pixel with colorAt(place in
    /// paint space); nothing to compare if its alpha is below 0.
    template <class ColorAt>
    void compare(VGPaint paint, double scale, ColorAt&& colorAt) {
        vgSetPaint(paint, VG_FILL_PATH);
        const scene::Affine user = rounded({scale, scale / 5, -scale / 7, scale, 20, 24}),
                            paintToUser =
                                rounded({uniform(0.7, 1.4), uniform(-0.4, 0.4), uniform(-0.4, 0.4),
                                         uniform(0.7, 1.4), uniform(-0.5, 0.5), uniform(-0.5, 0.5)});
        load(VG_MATRIX_PATH_USER_TO_SURFACE, user);
        load(VG_MATRIX_FILL_PAINT_TO_USER, paintToUser);
        clear();
        vgDrawPath(all_, VG_FILL_PATH);
        const std::vector<std::uint32_t> words = pixels(VG_sRGBA_8888_PRE);
        const auto square = [](const scene::Affine& m) {
            return glm::dmat3(m[0].x, m[0].y, 0, m[1].x, m[1].y, 0, m[2].x, m[2].y, 1);
        };
        const glm::dmat3 inverse = glm::inverse(square(user) * square(paintToUser));
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Color expected = colorAt(dvec2(inverse * glm::dvec3(x + 0.5, y + 0.5, 1)));
                if (expected.a < 0)
                    continue;
                const std::uint32_t word = words[std::size_t(y * side + x)];
                for (int c = 0; c < 4; ++c)
                    ASSERT_NEAR(double(word >> (24 - 8 * c) & 255), 255 * expected[c], paintBound)
                        << x << ' ' << y;
            }
    }

    struct Stop {
        double offset;
        Color color;  ///< as set
    };
    /// Section 9.3.3, and its formal definition of spread modes.
    static Color ramp(const std::vector<Stop>& stops, double offset, int spread, bool premultiplied) {
        const Color skip(0, 0, 0, -1);
        if (spread == VG_COLOR_RAMP_SPREAD_PAD) {
            offset = std::clamp(offset, 0.0, 1.0);
        } else {
            const double whole = std::floor(offset);
            if (spread == VG_COLOR_RAMP_SPREAD_REPEAT && std::abs(offset - std::round(offset)) < nearStep)
                return skip;
            offset -= whole;
            if (spread == VG_COLOR_RAMP_SPREAD_REFLECT && std::fmod(std::abs(whole), 2) == 1)
                offset = 1 - offset;
        }
        const auto whole = [](const Color& c) { return Color(c.r * c.a, c.g * c.a, c.b * c.a, c.a); };
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
            const Stop &a = stops[i], &b = stops[i + 1];
            if (a.offset == b.offset && std::abs(offset - a.offset) < nearStep)
                return skip;
            if (offset < a.offset || offset > b.offset || a.offset == b.offset)
                continue;
            const double t = (offset - a.offset) / (b.offset - a.offset);
            return premultiplied ? glm::mix(whole(a.color), whole(b.color), t)
                                 : whole(glm::mix(a.color, b.color, t));
        }
        return skip;
    }

    const std::vector<Stop> stops_{{0, {1, 0, 0, 1}},
                                   {0.25, {0, 1, 0.5, 0.25}},
                                   {0.5, {0, 0, 1, 1}},
                                   {0.5, {1, 1, 0, 0.75}},
                                   {1, {0.25, 0.5, 1, 0}}};
    VGPaint gradient(VGPaintType type, int spread, bool premultiplied) {
        const VGPaint paint = vgCreatePaint();
        vgSetParameteri(paint, VG_PAINT_TYPE, type);
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE, spread);
        vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, premultiplied);
        std::vector<VGfloat> numbers;
        for (const Stop& stop : stops_)
            for (const double v : {stop.offset, stop.color.r, stop.color.g, stop.color.b, stop.color.a})
                numbers.push_back(VGfloat(v));
        vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(numbers.size()), numbers.data());
        return paint;
    }

private:
    VtmSurface* plain_;
    VGPath all_;
};

TEST_F(PaintsCase, LinearGradients) {
    const std::array<VGfloat, 4> points{0.125f, 0.25f, 0.75f, 0.5f};
    const dvec2 start(points[0], points[1]), along = dvec2(points[2], points[3]) - start;
    for (int spread = VG_COLOR_RAMP_SPREAD_PAD; spread <= VG_COLOR_RAMP_SPREAD_REFLECT; ++spread)
        for (const bool premultiplied : {false, true}) {
            const VGPaint paint = gradient(VG_PAINT_TYPE_LINEAR_GRADIENT, spread, premultiplied);
            vgSetParameterfv(paint, VG_PAINT_LINEAR_GRADIENT, 4, points.data());
            compare(paint, 40, [&](dvec2 p) {
                return ramp(stops_, glm::dot(p - start, along) / glm::dot(along, along), spread,
                            premultiplied);
            });
            vgDestroyPaint(paint);
        }
}

TEST_F(PaintsCase, RadialGradients) {
    const std::array<VGfloat, 5> numbers{0.5f, 0.5f, 0.625f, 0.4375f, 0.375f};
    const dvec2 center(numbers[0], numbers[1]), focus(numbers[2], numbers[3]);
    const double radius = double(numbers[4]);
    for (int spread = VG_COLOR_RAMP_SPREAD_PAD; spread <= VG_COLOR_RAMP_SPREAD_REFLECT; ++spread) {
        const VGPaint paint = gradient(VG_PAINT_TYPE_RADIAL_GRADIENT, spread, true);
        vgSetParameterfv(paint, VG_PAINT_RADIAL_GRADIENT, 5, numbers.data());
        // Section 9.3.2: g where p lies on the circle about focus + g (center - focus) with radius g r, by
        // halving.
        compare(paint, 40, [&](dvec2 p) {
            double low = 0, high = 64;
            for (int i = 0; i < 60; ++i) {
                const double g = (low + high) / 2;
                (glm::distance(p, focus + g * (center - focus)) > g * radius ? low : high) = g;
            }
            return ramp(stops_, low, spread, true);
        });
        vgDestroyPaint(paint);
    }
}

TEST_F(PaintsCase, Patterns) {
    // 4 by 3 opaque texels, nearest: section 9.4.1.
    constexpr int width = 4, height = 3;
    const VGImage image = vgCreateImage(VG_sRGBA_8888, width, height, VG_IMAGE_QUALITY_NONANTIALIASED);
    std::vector<std::uint32_t> texels(width * height);
    for (std::uint32_t& texel : texels)
        texel = std::uint32_t(random_()) | 0xff;
    vgImageSubData(image, texels.data(), 4 * width, VG_sRGBA_8888, 0, 0, width, height);
    vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
    const std::array<VGfloat, 4> fill{0.25f, 0.5f, 0.75f, 1};
    vgSetfv(VG_TILE_FILL_COLOR, 4, fill.data());
    for (int mode = VG_TILE_FILL; mode <= VG_TILE_REFLECT; ++mode) {
        const VGPaint paint = vgCreatePaint();
        vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
        vgSetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE, mode);
        vgPaintPattern(paint, image);
        compare(paint, 8, [&](dvec2 p) {
            if (glm::distance(p.x, std::round(p.x)) < nearStep ||
                glm::distance(p.y, std::round(p.y)) < nearStep)
                return Color(0, 0, 0, -1);
            int x = int(std::floor(p.x)), y = int(std::floor(p.y));
            if (mode == VG_TILE_FILL && (x < 0 || y < 0 || x >= width || y >= height))
                return Color(fill[0], fill[1], fill[2], fill[3]);
            const auto along = [&](int i, int size) {
                if (mode == VG_TILE_FILL || mode == VG_TILE_PAD)
                    return std::clamp(i, 0, size - 1);
                const int period = mode == VG_TILE_REFLECT ? 2 * size : size,
                          j = (i % period + period) % period;
                return j < size ? j : period - 1 - j;
            };
            const std::uint32_t texel = texels[std::size_t(along(y, height) * width + along(x, width))];
            return Color(texel >> 24, texel >> 16 & 255, texel >> 8 & 255, texel & 255) / 255.0;
        });
        vgDestroyPaint(paint);
    }
    vgDestroyImage(image);
}

}  // namespace

}  // namespace vtm::cases::openvg

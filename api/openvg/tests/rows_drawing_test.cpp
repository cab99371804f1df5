// Rows of pixels that are drawn, beside single pixels: within 1/255.

#include "api/openvg/tests/rows_fixture.hpp"

namespace vtm::openvg::testing {
namespace {

TEST_F(RowsTest, Colours) {
    vgSetPaint(newPaint({0, 0, 0, 1}), VG_FILL_PATH);
    const VGPath path = rectangle(-10, -10, width + 20, height + 20);  // its edges are elsewhere
    for (const SurfaceKind& kind : surfaces)
        for (int i = 0; i < 30; ++i) {
            TwinDrawing drawing;
            const TwinImage before = prepare(kind, drawing);
            const std::array<VGfloat, 4> c{unit(), unit(), unit(), below(4) == 0 ? 1 : unit()};
            vgSetParameterfv(vgGetPaint(VG_FILL_PATH), VG_PAINT_COLOR, 4, c.data());
            vgDrawPath(path, VG_FILL_PATH);
            expectDrawn(before, drawing,
                        {sRGBA_PRE, [&](int, int) { return premultiplied(Color(c[0], c[1], c[2], c[3])); }},
                        "a colour");
        }
}

TEST_F(RowsTest, MovedImages) {
    for (const SurfaceKind& kind : surfaces)
        for (const VGImageFormat name : {kind.name, VG_sRGBA_8888, VG_sRGBA_8888_PRE, VG_sBGRX_8888,
                                         VG_sRGB_565, VG_lRGBA_8888_PRE, VG_sL_8, VG_A_8, VG_sARGB_4444})
            for (int i = 0; i < 8; ++i) {
                TwinDrawing drawing;
                const TwinImage before = prepare(kind, drawing);
                // Larger than the surface; upside down every other time.
                const TwinImage image = randomImage(name, width + 20, height + 4);
                const glm::mat3 toSurface(1, 0, 0, 0, i & 1 ? -1 : 1, 0, -below(20),
                                          i & 1 ? image.height - below(4) : -below(4), 1);
                draw(image, toSurface);
                expectDrawn(before, drawing, nearest(image, glm::inverse(glm::dmat3(toSurface))),
                            "a moved image");
            }
}

TEST_F(RowsTest, NearestPixels) {
    vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
    for (const SurfaceKind& kind : surfaces)
        for (const VGImageFormat name :
             {kind.name, VG_sRGBA_8888, VG_sRGBA_8888_PRE, VG_sXBGR_8888, VG_sRGB_565, VG_lL_8, VG_A_8})
            for (int i = 0; i < 8; ++i) {
                TwinDrawing drawing;
                const TwinImage before = prepare(kind, drawing);
                const TwinImage image = randomImage(name, 90, 70);
                const glm::mat3 toSurface = magnifying();
                draw(image, toSurface);
                expectDrawn(before, drawing, nearest(image, glm::inverse(glm::dmat3(toSurface))),
                            "nearest pixels");
            }
}

TEST_F(RowsTest, InterpolatedImages) {
    for (const SurfaceKind& kind : surfaces)
        for (const VGImageFormat name : {VG_sRGBA_8888, VG_sRGBA_8888_PRE, VG_sARGB_8888, VG_sXBGR_8888,
                                         VG_sRGBX_8888, VG_sRGB_565, VG_lL_8})
            for (int i = 0; i < 6; ++i) {
                TwinDrawing drawing;
                const TwinImage before = prepare(kind, drawing);
                const TwinImage image = randomImage(name, 90, 70);
                const glm::mat3 toSurface = magnifying();
                draw(image, toSurface);
                expectDrawn(before, drawing, bilinear(image, glm::inverse(glm::dmat3(toSurface))),
                            "an interpolated image");
            }
}

// ---- Gradients ------------------------------------------------------------------------------------

/// Stops with a jump, one of them translucent.
constexpr std::array<VGfloat, 25> stops{0,    1,    0.2f, 0, 1, 0.3f, 0, 0.8f, 0.3f, 0.4f, 0.3f, 1, 1,
                                        0.2f, 0.9f, 0.8f, 0, 0, 1,    1, 1,    0.1f, 0,    1,    1};

/// The ramp's colour by the formula of section 9.3.3, premultiplied.
Color rampColor(double v, VGColorRampSpreadMode spread, bool premultiplies) {
    if (spread == VG_COLOR_RAMP_SPREAD_REPEAT)
        v -= std::floor(v);
    if (spread == VG_COLOR_RAMP_SPREAD_REFLECT) {
        v = std::abs(std::fmod(v, 2));
        v = v > 1 ? 2 - v : v;
    }
    v = std::clamp(v, 0.0, 1.0);
    const auto color = [&](std::size_t i) {
        const Color c(stops[5 * i + 1], stops[5 * i + 2], stops[5 * i + 3], stops[5 * i + 4]);
        return premultiplies ? premultiplied(c) : c;
    };
    std::size_t i = 0;
    while (i + 2 < stops.size() / 5 && v >= double(stops[5 * i + 5]))
        ++i;
    const auto low = double(stops[5 * i]), high = double(stops[5 * i + 5]);
    const Color c = glm::mix(color(i), color(i + 1), float((v - low) / (high - low)));
    return premultiplies ? c : premultiplied(c);
}

TEST_F(RowsTest, Gradients) {
    const VGPath path = rectangle(-10, -10, width + 20, height + 20);  // its edges are elsewhere
    const VGPaint paint = vgCreatePaint();
    vgSetPaint(paint, VG_FILL_PATH);
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(stops.size()), stops.data());
    for (const SurfaceKind& kind : surfaces)
        for (const auto spread :
             {VG_COLOR_RAMP_SPREAD_PAD, VG_COLOR_RAMP_SPREAD_REPEAT, VG_COLOR_RAMP_SPREAD_REFLECT})
            for (const bool premultiplies : {false, true})
                for (const bool isRadial : {false, true}) {
                    TwinDrawing drawing;
                    const TwinImage before = prepare(kind, drawing);
                    vgSetParameteri(paint, VG_PAINT_TYPE,
                                    isRadial ? VG_PAINT_TYPE_RADIAL_GRADIENT : VG_PAINT_TYPE_LINEAR_GRADIENT);
                    vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE, spread);
                    vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, premultiplies);
                    // Values that no pixel has in common with a jump.
                    const std::array<VGfloat, 5> p{60.013f + 20 * unit(), 1, 40 + 20 * unit(), 2,
                                                   31 + 20 * unit()};
                    vgSetParameterfv(paint, VG_PAINT_RADIAL_GRADIENT, 5, p.data());
                    vgSetParameterfv(paint, VG_PAINT_LINEAR_GRADIENT, 4, p.data());
                    vgDrawPath(path, VG_FILL_PATH);
                    const auto value = [&](double x, double y) {
                        const glm::dvec2 a(p[0], p[1]), b(p[2], p[3]), at(x + 0.5, y + 0.5);
                        if (!isRadial)
                            return glm::dot(at - a, b - a) / glm::dot(b - a, b - a);
                        const glm::dvec2 f = b - a, d = at - b;
                        const double r = double(p[4]), cross = d.x * f.y - d.y * f.x;
                        return (glm::dot(d, f) + std::sqrt(r * r * glm::dot(d, d) - cross * cross)) /
                               (r * r - glm::dot(f, f));
                    };
                    expectDrawn(before, drawing,
                                {sRGBA_PRE,
                                 [&](int x, int y) { return rampColor(value(x, y), spread, premultiplies); }},
                                "a gradient");
                }
}

}  // namespace
}  // namespace vtm::openvg::testing

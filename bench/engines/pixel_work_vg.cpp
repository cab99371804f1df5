#include <cmath>
#include <optional>
#include <string>

#include "bench/engines/pixel_work.hpp"
#include "bench/engines/vg_canvas.hpp"
#include "bench/input/font.hpp"

namespace vtm::bench {

namespace {

VGPaint gradient(VGPaintType type, std::initializer_list<VGfloat> place) {
    const VGfloat stops[]{0, 1, 0.2f, 0, 1, 0.4f, 0, 0.8f, 0.3f, 1, 1, 0.1f, 0, 1, 1};
    const VGPaint paint = vgCreatePaint();
    vgSetParameteri(paint, VG_PAINT_TYPE, type);
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 15, stops);
    vgSetParameterfv(
        paint, type == VG_PAINT_TYPE_LINEAR_GRADIENT ? VG_PAINT_LINEAR_GRADIENT : VG_PAINT_RADIAL_GRADIENT,
        VGint(place.size()), place.begin());
    return paint;
}

VGPath square(VGfloat side) {
    const VGubyte commands[]{VG_MOVE_TO_ABS, VG_HLINE_TO_ABS, VG_VLINE_TO_ABS, VG_HLINE_TO_ABS,
                             VG_CLOSE_PATH};
    const VGfloat numbers[]{0, 0, side, side, 0};
    const VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    vgAppendPathData(path, 5, commands, numbers);
    return path;
}

/// Premultiplied, in the order of a surface's bytes.
constexpr auto format = VG_sABGR_8888_PRE;

/// From the sheet, in which a line of DejaVu Sans has the height 1, to pixels: 16 of them an em.
constexpr double glyphScale = 16 * 1.164;

VGImage imageOf(const std::vector<std::uint32_t>& pixels, int side, VGImageFormat stored = format) {
    const VGImage image = vgCreateImage(stored, side, side, VG_IMAGE_QUALITY_FASTER);
    vgImageSubData(image, pixels.data(), 4 * side, stored, 0, 0, side, side);
    return image;
}

/// Of a sheet's glyphs, their origin the first point. VG_INVALID_HANDLE if there is no sheet.
VGFont sheetFont() {
    std::string why;
    const std::optional<scene::Scene> sheet = fontSheet("", why);
    if (!sheet)
        return VG_INVALID_HANDLE;
    const VGFont font = vgCreateFont(100);
    VGuint index = 0;
    for (const scene::Node& node : sheet->root.children) {
        const auto* item = std::get_if<scene::Item>(&node.value);
        if (!item || item->path->empty())
            continue;
        const VGPath path =
            vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        VgCanvas::set(path, *item->path);
        const scene::Point at = *scene::endOf(item->path->front());
        const VGfloat origin[]{VGfloat(at.x), VGfloat(at.y)},
            escapement[]{VGfloat(glyphAdvance / glyphScale), 0};
        vgSetGlyphToPath(font, index++, path, VG_FALSE, origin, escapement);
    }
    return font;
}

struct VgWork : VgCanvas {
    std::vector<std::uint32_t> pixels = premultipliedPixels(copiedSide);
    VGImage moved = imageOf(premultipliedPixels(movedSide), movedSide), large = imageOf(pixels, copiedSide),
            other = imageOf(pixels, copiedSide), straight = imageOf(pixels, copiedSide, VG_sRGBA_8888);
    VGPath all = square(workSide), part = square(700);
    VGPaint linear = gradient(VG_PAINT_TYPE_LINEAR_GRADIENT, {10, 20, 700, 600}),
            radial = gradient(VG_PAINT_TYPE_RADIAL_GRADIENT, {400, 400, 350, 420, 450}),
            translucent = vgCreatePaint(), ink = vgCreatePaint();
    VGFont font = sheetFont();

    explicit VgWork(VtmCompositor compositor) : VgCanvas(compositor, workSide) {
        vgSetColor(translucent, 0xe6661a4d);
        vgSeti(VG_FILTER_FORMAT_PREMULTIPLIED, VG_TRUE);
    }
    void drawImage(VGfloat scale, VGfloat angle, VGfloat x, VGfloat y) {
        const VGfloat c = scale * std::cos(angle), s = scale * std::sin(angle),
                      matrix[]{c, s, 0, -s, c, 0, x, y, 1};
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
        vgLoadMatrix(matrix);
        vgDrawImage(moved);
    }
    void drawTurned(int i) {
        const VGfloat angle = 0.3f + VGfloat(i), c = 1.4f * std::cos(angle), s = 1.4f * std::sin(angle);
        constexpr VGfloat half = movedSide / 2, middle = workSide / 2;
        drawImage(1.4f, angle, middle - half * (c - s), middle - half * (s + c));
    }
    void fill(VGPath path, VGPaint paint) {
        vgSetPaint(paint, VG_FILL_PATH);
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
        vgLoadIdentity();
        vgDrawPath(path, VG_FILL_PATH);
    }
    void text() {
        vgSetPaint(ink, VG_FILL_PATH);
        vgSeti(VG_MATRIX_MODE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
        vgSeti(VG_FILL_RULE, VG_NON_ZERO);
        const int count = vgGetParameteri(font, VG_FONT_NUM_GLYPHS);
        VGuint indices[lineGlyphs];
        for (int line = 0; line < textLines; ++line) {
            for (int i = 0; i < lineGlyphs; ++i)
                indices[i] = VGuint((line * lineGlyphs + i) % count);
            const VGfloat matrix[]{
                VGfloat(glyphScale), 0, 0, 0, VGfloat(glyphScale), 0, 4, VGfloat(14 + line * lineAdvance), 1},
                start[]{0, 0};
            vgLoadMatrix(matrix);
            vgSetfv(VG_GLYPH_ORIGIN, 2, start);
            vgDrawGlyphs(font, lineGlyphs, indices, nullptr, nullptr, VG_FILL_PATH, VG_FALSE);
        }
    }
    void upload(VGImage image, VGImageFormat given) {
        vgImageSubData(image, pixels.data(), 4 * copiedSide, given, 0, 0, copiedSide, copiedSide);
    }
    void blur(VGfloat deviation) { vgGaussianBlur(other, large, deviation, deviation, VG_TILE_FILL); }
};

}  // namespace

std::vector<std::uint32_t> premultipliedPixels(int side) {
    std::vector<std::uint32_t> pixels;
    for (unsigned y = 0; y < unsigned(side); ++y)
        for (unsigned x = 0; x < unsigned(side); ++x) {
            const unsigned alpha = (x + y) & 255;
            const auto channel = [&](unsigned v) { return (v & 255) * alpha / 255; };
            pixels.push_back(alpha << 24 | channel(x) << 16 | channel(y) << 8 | channel(x ^ y));
        }
    return pixels;
}

std::vector<PixelWork> vgPixelWork(VtmCompositor compositor) {
    const auto canvas = std::make_shared<VgWork>(compositor);
    return {
        {"image moved by whole pixels",
         [=](int i) { canvas->drawImage(1, 0, VGfloat(i * 37 % 500), VGfloat(i * 91 % 500)); }},
        {"image rotated and scaled", [=](int i) { canvas->drawTurned(i); }},
        {"the same, nearest pixels",
         [=](int i) {
             vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
             canvas->drawTurned(i);
             vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_FASTER);
         }},
        {"linear gradient", [=](int) { canvas->fill(canvas->all, canvas->linear); }},
        {"radial gradient", [=](int) { canvas->fill(canvas->all, canvas->radial); }},
        {"translucent rectangle", [=](int) { canvas->fill(canvas->part, canvas->translucent); }},
        {"text, the same every frame", [=](int) { canvas->text(); }},
        {"text on white, cleared every frame",
         [=](int) {
             vgClear(0, 0, workSide, workSide);
             canvas->text();
         }},
        {"upload", [=](int) { canvas->upload(canvas->straight, VG_sRGBA_8888); }},
        {"upload, premultiplied", [=](int) { canvas->upload(canvas->large, format); }},
        {"upload, premultiplied on the way", [=](int) { canvas->upload(canvas->large, VG_sRGBA_8888); }},
        {"read back",
         [=](int) {
             vgReadPixels(canvas->pixels.data(), 4 * copiedSide, format, 0, 0, copiedSide, copiedSide);
         }},
        {"copy",
         [=](int) {
             vgCopyImage(canvas->other, 0, 0, canvas->large, 0, 0, copiedSide, copiedSide, VG_FALSE);
         }},
        {"blur, deviation 2", [=](int) { canvas->blur(2); }},
        {"blur, deviation 20", [=](int) { canvas->blur(20); }},
    };
}

}  // namespace vtm::bench

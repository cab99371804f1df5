#include "bench/engines/pixel_work.hpp"

#ifdef VTM_HAVE_RSVG
#include <cairo.h>
#endif

namespace vtm::bench {

#ifdef VTM_HAVE_RSVG

namespace {

struct Surface {
    explicit Surface(int side)
        : surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, side, side)), c(cairo_create(surface)) {}
    Surface(std::vector<std::uint32_t>& pixels, int side)
        : surface(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                                      CAIRO_FORMAT_ARGB32, side, side, 4 * side)),
          c(cairo_create(surface)) {}
    ~Surface() {
        cairo_destroy(c);
        cairo_surface_destroy(surface);
    }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    cairo_surface_t* surface;
    cairo_t* c;
};

/// Takes over the pattern.
void fillRectangle(cairo_t* c, cairo_pattern_t* pattern, double size) {
    cairo_identity_matrix(c);
    cairo_set_source(c, pattern);
    cairo_rectangle(c, 0, 0, size, size);
    cairo_fill(c);
    cairo_pattern_destroy(pattern);
}

cairo_pattern_t* withStops(cairo_pattern_t* pattern) {
    cairo_pattern_add_color_stop_rgba(pattern, 0, 1, 0.2, 0, 1);
    cairo_pattern_add_color_stop_rgba(pattern, 0.4, 0, 0.8, 0.3, 1);
    cairo_pattern_add_color_stop_rgba(pattern, 1, 0.1, 0, 1, 1);
    return pattern;
}

void showText(cairo_t* c) {
    cairo_identity_matrix(c);
    cairo_set_source_rgb(c, 0, 0, 0);
    cairo_select_font_face(c, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c, 16);
    cairo_glyph_t glyphs[lineGlyphs];
    for (int line = 0; line < textLines; ++line) {
        for (int i = 0; i < lineGlyphs; ++i)
            // The printable ones of ASCII, from ! on.
            glyphs[i] = {4ul + unsigned(line * lineGlyphs + i) % 94, 4 + i * glyphAdvance,
                         14 + line * lineAdvance};
        cairo_show_glyphs(c, glyphs, lineGlyphs);
    }
}

void copy(Surface& to, const Surface& from, int side) {
    cairo_set_operator(to.c, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_surface(to.c, from.surface, 0, 0);
    cairo_rectangle(to.c, 0, 0, side, side);
    cairo_fill(to.c);
    cairo_set_operator(to.c, CAIRO_OPERATOR_OVER);
}

cairo_matrix_t turned(int i) {
    cairo_matrix_t matrix;
    cairo_matrix_init_translate(&matrix, workSide / 2, workSide / 2);
    cairo_matrix_rotate(&matrix, 0.3 + i);
    cairo_matrix_scale(&matrix, 1.4, 1.4);
    cairo_matrix_translate(&matrix, -movedSide / 2, -movedSide / 2);
    return matrix;
}

struct CairoWork {
    std::vector<std::uint32_t> moved = premultipliedPixels(movedSide),
                               copied = premultipliedPixels(copiedSide);
    Surface target{workSide}, image{moved, movedSide}, memory{copied, copiedSide}, large{copiedSide},
        drawn{workSide};

    CairoWork() {
        // Of an empty surface cairo would copy nothing.
        cairo_set_source_rgb(drawn.c, 0.5, 0.6, 0.7);
        cairo_paint(drawn.c);
    }

    void drawImage(const cairo_matrix_t& matrix, cairo_filter_t filter = CAIRO_FILTER_BILINEAR) {
        cairo_set_matrix(target.c, &matrix);
        cairo_set_source_surface(target.c, image.surface, 0, 0);
        cairo_pattern_set_filter(cairo_get_source(target.c), filter);
        cairo_rectangle(target.c, 0, 0, movedSide, movedSide);
        cairo_fill(target.c);
    }
};

}  // namespace

std::vector<PixelWork> cairoPixelWork() {
    const auto canvas = std::make_shared<CairoWork>();
    cairo_t* const c = canvas->target.c;
    return {
        {"image moved by whole pixels",
         [=](int i) {
             cairo_matrix_t matrix;
             cairo_matrix_init_translate(&matrix, i * 37 % 500, i * 91 % 500);
             canvas->drawImage(matrix);
         }},
        {"image rotated and scaled", [=](int i) { canvas->drawImage(turned(i)); }},
        {"the same, nearest pixels", [=](int i) { canvas->drawImage(turned(i), CAIRO_FILTER_NEAREST); }},
        {"linear gradient",
         [=](int i) {
             fillRectangle(c, withStops(cairo_pattern_create_linear(10 + i % 7, 20, 700, 600)), workSide);
         }},
        {"radial gradient",
         [=](int i) {
             fillRectangle(c, withStops(cairo_pattern_create_radial(350 + i % 7, 420, 0, 400, 400, 450)),
                           workSide);
         }},
        {"translucent rectangle",
         [=](int) { fillRectangle(c, cairo_pattern_create_rgba(0.9, 0.4, 0.1, 0.3), 700); }},
        {"text, the same every frame", [=](int) { showText(c); }},
        {"text on white, cleared every frame",
         [=](int) {
             cairo_set_source_rgb(c, 1, 1, 1);
             cairo_paint(c);
             showText(c);
         }},
        {"upload", [=](int) { copy(canvas->large, canvas->memory, copiedSide); }},
        {"upload, premultiplied", [=](int) { copy(canvas->large, canvas->memory, copiedSide); }},
        {"read back", [=](int) { copy(canvas->memory, canvas->drawn, copiedSide); }},
        {"copy", [=](int) { copy(canvas->target, canvas->large, copiedSide); }},
    };
}

#else

std::vector<PixelWork> cairoPixelWork() { return {}; }

#endif

}  // namespace vtm::bench

/* An image, three paints and a font: a label with a gradient, a tiled image and the word OpenVG, in a PPM
   file. cc label.c $(pkg-config --cflags --libs openvg) -o label; ./label label.ppm */
#include <VG/openvg.h>
#include <VG/vgu.h>
#include <string.h>

#include "offscreen.h"

enum { width = 400, height = 240 };

/* From dark blue at the bottom to light blue at the top: offset, red, green, blue, alpha for each stop. */
static VGPaint sky(void) {
    static const VGfloat line[] = {0, 0, 0, height};
    static const VGfloat stops[] = {0, 0.1f, 0.2f, 0.5f, 1, 1, 0.7f, 0.85f, 1, 1};
    VGPaint paint = vgCreatePaint();
    vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_LINEAR_GRADIENT);
    vgSetParameterfv(paint, VG_PAINT_LINEAR_GRADIENT, 4, line);
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, 10, stops);
    return paint;
}

/* Four squares, red and yellow. The first row of the data is the lowest one of the image. */
static VGImage checks(void) {
    static const VGuint pixels[] = {0xff0000ff, 0xffff00ff, 0xffff00ff, 0xff0000ff};
    VGImage image = vgCreateImage(VG_sRGBA_8888, 2, 2, VG_IMAGE_QUALITY_NONANTIALIASED);
    vgImageSubData(image, pixels, 2 * sizeof(VGuint), VG_sRGBA_8888, 0, 0, 2, 2);
    return image;
}

/* The image repeated in both directions, each of its pixels 10 wide and high. */
static VGPaint tiles(VGImage image) {
    VGPaint paint = vgCreatePaint();
    vgSetParameteri(paint, VG_PAINT_TYPE, VG_PAINT_TYPE_PATTERN);
    vgSetParameteri(paint, VG_PAINT_PATTERN_TILING_MODE, VG_TILE_REPEAT);
    vgPaintPattern(paint, image);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_FILL_PAINT_TO_USER);
    vgLoadIdentity();
    vgScale(10, 10);
    return paint;
}

/* A letter's lines, stroked. Glyphs share its path, so it may be destroyed at once. */
static void add_glyph(VGFont font, VGuint letter, const char* commands, const VGfloat* points,
                      VGfloat advance) {
    static const VGfloat origin[] = {0, 0};
    const VGfloat escapement[] = {advance, 0};
    VGubyte segments[16];
    const VGint count = (VGint)strlen(commands);
    for (VGint i = 0; i < count; ++i)
        segments[i] = commands[i] == 'M'   ? VG_MOVE_TO_ABS
                      : commands[i] == 'C' ? VG_CUBIC_TO_ABS
                                           : VG_LINE_TO_ABS;
    VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
    vgAppendPathData(path, count, segments, points);
    vgSetGlyphToPath(font, letter, path, VG_FALSE, origin, escapement);
    vgDestroyPath(path);
}

static VGFont letters(void) {
    static const VGfloat o[] = {30, 0, 0, 0, 0, 70, 30, 70, 60, 70, 60, 0, 30, 0};
    static const VGfloat p[] = {0, -20, 0, 45, 0, 25, 0, 65, 42, 62, 42, 25, 42, -12, 0, -12, 0, 20};
    static const VGfloat e[] = {2, 24, 38, 24, 40, 55, 0, 55, 2, 22, 4, -6, 30, -2, 38, 8};
    static const VGfloat n[] = {0, 0, 0, 45, 0, 28, 5, 50, 35, 55, 35, 25, 35, 0};
    static const VGfloat v[] = {0, 70, 28, 0, 56, 70};
    static const VGfloat g[] = {55, 60, 40, 75, 0, 75, 0, 35, 0, -8, 50, -8, 55, 10, 55, 32, 32, 32};
    VGFont font = vgCreateFont(6);
    add_glyph(font, 'O', "MCC", o, 72);
    add_glyph(font, 'p', "MLMCC", p, 46);
    add_glyph(font, 'e', "MLCC", e, 52);
    add_glyph(font, 'n', "MLMCL", n, 50);
    add_glyph(font, 'V', "MLL", v, 66);
    add_glyph(font, 'G', "MCCLL", g, 0);
    return font;
}

/* The baseline begins at the glyph origin; each glyph moves it by its escapement. */
static void write_word(VGFont font, VGfloat x, VGfloat y) {
    static const VGuint word[] = {'O', 'p', 'e', 'n', 'V', 'G'};
    const VGfloat origin[] = {x, y};
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    vgLoadIdentity();
    vgSetfv(VG_GLYPH_ORIGIN, 2, origin);
    vgDrawGlyphs(font, 6, word, NULL, NULL, VG_STROKE_PATH, VG_TRUE);
}

int main(int argc, char** argv) {
    require(argc == 2, "usage: label FILE.ppm");
    open_pbuffer(width, height);
    VGPath box =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);

    VGPaint gradient = sky();
    vguRect(box, 0, 0, width, height);
    vgSetPaint(gradient, VG_FILL_PATH);
    vgDrawPath(box, VG_FILL_PATH);

    VGImage image = checks();
    VGPaint pattern = tiles(image);
    vgClearPath(box, VG_PATH_CAPABILITY_ALL);
    vguRoundRect(box, 20, 20, width - 40, 40, 20, 20);
    vgSeti(VG_IMAGE_QUALITY, VG_IMAGE_QUALITY_NONANTIALIASED);
    vgSetPaint(pattern, VG_FILL_PATH);
    vgDrawPath(box, VG_FILL_PATH);

    /* The image itself, 20 times as large, in the upper left corner. */
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_IMAGE_USER_TO_SURFACE);
    vgTranslate(20, height - 60);
    vgScale(20, 20);
    vgDrawImage(image);

    VGPaint white = vgCreatePaint();
    VGFont font = letters();
    vgSetColor(white, 0xffffffff);
    vgSetPaint(white, VG_STROKE_PATH);
    vgSetf(VG_STROKE_LINE_WIDTH, 9);
    vgSeti(VG_STROKE_CAP_STYLE, VG_CAP_ROUND);
    vgSeti(VG_STROKE_JOIN_STYLE, VG_JOIN_ROUND);
    write_word(font, 30, 95);

    write_ppm(argv[1], width, height);
    close_pbuffer(); /* and with the context all that was created in it */
    return 0;
}

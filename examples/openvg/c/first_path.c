/* A first path: a star, filled and stroked, in a PPM file.
   cc first_path.c $(pkg-config --cflags --libs openvg) -o first_path; ./first_path star.ppm */
#include <VG/openvg.h>

#include "offscreen.h"

enum { width = 320, height = 240 };

/* Paints hold straight alpha; 0xRRGGBBAA. */
static VGPaint color_paint(VGuint rgba) {
    VGPaint paint = vgCreatePaint();
    vgSetColor(paint, rgba);
    return paint;
}

static VGPath star(void) {
    static const VGubyte segments[] = {VG_MOVE_TO_ABS, VG_LINE_TO_ABS, VG_LINE_TO_ABS,
                                       VG_LINE_TO_ABS, VG_LINE_TO_ABS, VG_CLOSE_PATH};
    static const VGfloat points[] = {0, 100, 59, -81, -95, 31, 95, 31, -59, -81};
    VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 6, 10, VG_PATH_CAPABILITY_ALL);
    vgAppendPathData(path, 6, segments, points);
    return path;
}

int main(int argc, char** argv) {
    static const VGfloat paper[] = {1, 1, 1, 1};
    require(argc == 2, "usage: first_path FILE.ppm");
    open_pbuffer(width, height);

    vgSetfv(VG_CLEAR_COLOR, 4, paper);
    vgClear(0, 0, width, height);

    /* The origin is the lower left corner, and y goes upwards. */
    VGPath path = star();
    VGPaint gold = color_paint(0xffc000ff), ink = color_paint(0x203060ff);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(width / 2, height / 2 - 8);
    vgSeti(VG_FILL_RULE, VG_NON_ZERO);
    vgSetf(VG_STROKE_LINE_WIDTH, 6);
    vgSeti(VG_STROKE_JOIN_STYLE, VG_JOIN_ROUND);
    vgSetPaint(gold, VG_FILL_PATH);
    vgSetPaint(ink, VG_STROKE_PATH);
    vgDrawPath(path, VG_FILL_PATH | VG_STROKE_PATH);

    write_ppm(argv[1], width, height);
    vgDestroyPath(path);
    vgDestroyPaint(gold);
    vgDestroyPaint(ink);
    close_pbuffer();
    return 0;
}

#include "examples/openvg/paints.hpp"

namespace paints {

namespace {

VGPaint gradient(VGPaintType type, const Ramp& ramp) {
    std::vector<VGfloat> stops;  // offset, red, green, blue, alpha of each
    for (const auto& [offset, rgba] : ramp) {
        stops.push_back(offset);
        for (const int shift : {24, 16, 8, 0})
            stops.push_back(VGfloat(rgba >> shift & 0xff) / 255);
    }
    const VGPaint paint = vgCreatePaint();
    vgSetParameteri(paint, VG_PAINT_TYPE, type);
    vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, VG_TRUE);
    vgSetParameterfv(paint, VG_PAINT_COLOR_RAMP_STOPS, VGint(stops.size()), stops.data());
    return paint;
}

}  // namespace

VGPaint solid(VGuint rgba) {
    const VGPaint paint = vgCreatePaint();
    vgSetColor(paint, rgba);
    return paint;
}

VGPaint linear(VGfloat x0, VGfloat y0, VGfloat x1, VGfloat y1, const Ramp& ramp) {
    const VGPaint paint = gradient(VG_PAINT_TYPE_LINEAR_GRADIENT, ramp);
    const VGfloat points[] = {x0, y0, x1, y1};
    vgSetParameterfv(paint, VG_PAINT_LINEAR_GRADIENT, 4, points);
    return paint;
}

VGPaint radial(VGfloat cx, VGfloat cy, VGfloat fx, VGfloat fy, VGfloat radius, const Ramp& ramp) {
    const VGPaint paint = gradient(VG_PAINT_TYPE_RADIAL_GRADIENT, ramp);
    const VGfloat circle[] = {cx, cy, fx, fy, radius};
    vgSetParameterfv(paint, VG_PAINT_RADIAL_GRADIENT, 5, circle);
    return paint;
}

void fillOnce(VGPath path, VGPaint paint) {
    vgSetPaint(paint, VG_FILL_PATH);
    vgDestroyPaint(paint);  // the context keeps it while it is set
    vgDrawPath(path, VG_FILL_PATH);
}

void strokeOnce(VGPath path, VGPaint paint, VGfloat width) {
    vgSetPaint(paint, VG_STROKE_PATH);
    vgDestroyPaint(paint);
    vgSetf(VG_STROKE_LINE_WIDTH, width);
    vgDrawPath(path, VG_STROKE_PATH);
}

}  // namespace paints

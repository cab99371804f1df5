#include "examples/openvg/digits.hpp"

#include <VG/vgu.h>

namespace digits {

namespace {

constexpr VGfloat width = 10, height = 18, advance = 14;  // of a digit, in its own units
constexpr VGfloat half = 1.3f;                            // of a segment's thickness
constexpr VGfloat gap = 0.35f;                            // between the ends of two segments

/// A bar with pointed ends from (x0, y0) to (x1, y1), which lie on one horizontal or vertical line.
void addSegment(VGPath path, VGfloat x0, VGfloat y0, VGfloat x1, VGfloat y1) {
    const VGfloat dx = x1 > x0 ? 1.0f : 0.0f, dy = y1 > y0 ? 1.0f : 0.0f;  // along; (dy, dx) is across
    const VGfloat ax = x0 + gap * dx, ay = y0 + gap * dy, bx = x1 - gap * dx, by = y1 - gap * dy;
    const VGfloat points[] = {
        ax, ay, ax + half * (dx + dy), ay + half * (dx + dy), bx - half * (dx - dy), by + half * (dx - dy),
        bx, by, bx - half * (dx + dy), by - half * (dx + dy), ax + half * (dx - dy), ay - half * (dx - dy)};
    vguPolygon(path, points, 6, VG_TRUE);
}

VGPath makeDigit(unsigned lit) {
    constexpr VGfloat l = half, r = width - half, b = half, m = height / 2, t = height - half;
    constexpr VGfloat ends[7][4] = {{l, t, r, t}, {r, m, r, t}, {r, b, r, m}, {l, b, r, b},
                                    {l, b, l, m}, {l, m, l, t}, {l, m, r, m}};
    const VGPath path =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_APPEND_TO);
    for (int segment = 0; segment < 7; ++segment)
        if (lit >> segment & 1)
            addSegment(path, ends[segment][0], ends[segment][1], ends[segment][2], ends[segment][3]);
    return path;
}

}  // namespace

Digits::Digits() {
    // Bits: top, upper right, lower right, bottom, lower left, upper left, middle.
    constexpr unsigned lit[10] = {0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f};
    for (int i = 0; i < 10; ++i)
        paths_[i] = makeDigit(lit[i]);
}

Digits::~Digits() {
    for (const VGPath path : paths_)
        vgDestroyPath(path);
}

void Digits::draw(const std::string& number, VGfloat x, VGfloat y, VGfloat size) const {
    VGfloat before[9];
    vgGetMatrix(before);
    vgTranslate(x, y);
    vgScale(size / height, size / height);
    vgShear(0.12f, 0);
    vgTranslate(-(advance * VGfloat(number.size()) - (advance - width)) / 2, -height / 2);
    for (const char c : number) {
        if (c != ' ')
            vgDrawPath(paths_[std::size_t(c - '0')], VG_FILL_PATH);
        vgTranslate(advance, 0);
    }
    vgLoadMatrix(before);
}

}  // namespace digits

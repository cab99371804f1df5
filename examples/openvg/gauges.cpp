// A car's gauge cluster: vg_gauges OUT.png|window [SECONDS]
//
// Shapes by VGU, gradients, scales that are dashes, needles that are turned by a matrix, glass that is a
// mask, bars cut to their level by scissoring. Shapes and paints are made where they are drawn and dropped at
// once, as in a sketch; only the digits are kept.

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include <VG/openvg.h>
#include <VG/vgu.h>

#include "examples/openvg/digits.hpp"
#include "examples/openvg/paints.hpp"
#include "examples/openvg/stage.hpp"

namespace {

constexpr int width = 960, height = 420;
constexpr VGfloat firstAngle = 225, sweep = -270;  // degrees, counter-clockwise from three o'clock

VGPath newPath() {
    return vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
}

VGPath disc(VGfloat x, VGfloat y, VGfloat radius) {
    const VGPath path = newPath();
    vguEllipse(path, x, y, 2 * radius, 2 * radius);
    return path;
}

VGPath roundRect(VGfloat x, VGfloat y, VGfloat w, VGfloat h, VGfloat corner) {
    const VGPath path = newPath();
    vguRoundRect(path, x, y, w, h, 2 * corner, 2 * corner);
    return path;
}

/// The part of the scale's circle from 0 to `share` in [0, 1].
VGPath scaleArc(VGfloat radius, VGfloat share) {
    const VGPath path = newPath();
    vguArc(path, 0, 0, 2 * radius, 2 * radius, firstAngle, sweep * share, VGU_ARC_OPEN);
    return path;
}

/// The origin of all that is drawn next.
void moveTo(VGfloat x, VGfloat y) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(x, y);
}

void fill(VGPath path, VGPaint paint) {
    paints::fillOnce(path, paint);
    vgDestroyPath(path);
}

void stroke(VGPath path, VGPaint paint, VGfloat lineWidth) {
    paints::strokeOnce(path, paint, lineWidth);
    vgDestroyPath(path);
}

// ---- A round instrument -------------------------------------------------------------------------------

struct Dial {
    VGfloat x, y;        // its middle
    int numbers, step;   // labels 0, step, 2 step, …; `numbers` intervals
    VGfloat maximum;     // at the end of the scale
    VGfloat warning;     // the red part's begin
    VGuint light, deep;  // of the arc that shows the value
};

constexpr VGfloat rimRadius = 186, faceRadius = 172;

/// Marks along the scale: dashes `mark` wide, `count` intervals over the whole.
void drawMarks(VGfloat radius, int count, VGfloat mark, VGfloat length, VGuint color) {
    const VGPath arc = scaleArc(radius, 1);
    const VGfloat interval = vgPathLength(arc, 0, 2) / VGfloat(count);
    const VGfloat dashes[] = {mark, interval - mark};
    vgSetfv(VG_STROKE_DASH_PATTERN, 2, dashes);
    vgSetf(VG_STROKE_DASH_PHASE, mark / 2);  // the first mark's middle lies on the begin
    stroke(arc, paints::solid(color), length);
    vgSetfv(VG_STROKE_DASH_PATTERN, 0, nullptr);
}

void drawFace(const Dial& dial, const digits::Digits& digits) {
    fill(disc(0, -6, rimRadius + 3),
         paints::radial(0, -6, 0, -6, rimRadius + 3, {{0.9f, 0x000000ff}, {1, 0x00000000}}));
    fill(disc(0, 0, rimRadius),
         paints::linear(
             -120, 150, 120, -150,
             {{0, 0xf4f7faff}, {0.3f, 0x8a95a3ff}, {0.5f, 0xd6dce3ff}, {0.7f, 0x59626eff}, {1, 0x2a3038ff}}));
    fill(disc(0, 0, faceRadius + 4), paints::linear(0, 170, 0, -170, {{0, 0x0b0e13ff}, {1, 0x6c7684ff}}));
    fill(disc(0, 0, faceRadius),
         paints::radial(0, 0, 0, 50, faceRadius, {{0, 0x24344dff}, {0.62f, 0x121c2eff}, {1, 0x070b14ff}}));
    drawMarks(155, 4 * dial.numbers, 1.2f, 8, 0x9fb3c8ff);
    drawMarks(152, dial.numbers, 3.2f, 15, 0xffffffff);

    const VGPaint ink = paints::solid(0xd9e6f2ff);
    vgSetPaint(ink, VG_FILL_PATH);
    vgDestroyPaint(ink);
    for (int i = 0; i <= dial.numbers; ++i) {
        const double angle =
            double(firstAngle + sweep * VGfloat(i) / VGfloat(dial.numbers)) * std::numbers::pi / 180;
        digits.draw(std::to_string(i * dial.step), VGfloat(124 * std::cos(angle)),
                    VGfloat(124 * std::sin(angle)), 13);
    }
}

/// What has been reached, as a glowing arc with round ends, and what should not be, in red.
void drawArcs(const Dial& dial, VGfloat value) {
    const VGPath whole = scaleArc(97, 1), dots = scaleArc(83, 1);
    vgSeti(VG_STROKE_CAP_STYLE, VG_CAP_ROUND);
    stroke(whole, paints::solid(0x2b3c55ff), 9);

    const VGPath red = newPath();
    const VGfloat begin = dial.warning / dial.maximum;
    vguArc(red, 0, 0, 194, 194, firstAngle + sweep * begin, sweep * (1 - begin), VGU_ARC_OPEN);
    stroke(red, paints::solid(0x8f2334ff), 9);

    const VGPath reached = scaleArc(97, value / dial.maximum);
    paints::strokeOnce(
        reached, paints::linear(-97, 0, 97, 0, {{0, dial.deep & 0xffffff38}, {1, dial.light & 0xffffff38}}),
        17);
    stroke(reached, paints::linear(-97, 0, 97, 0, {{0, dial.deep}, {1, dial.light}}), 9);

    // Dashes of no length with round caps are dots.
    const VGfloat dashes[] = {0, vgPathLength(dots, 0, 2) / 60};
    vgSetfv(VG_STROKE_DASH_PATTERN, 2, dashes);
    vgSetf(VG_STROKE_DASH_PHASE, 0);
    stroke(dots, paints::solid(0x4a6283ff), 2.4f);
    vgSetfv(VG_STROKE_DASH_PATTERN, 0, nullptr);
    vgSeti(VG_STROKE_CAP_STYLE, VG_CAP_BUTT);
}

void drawNeedle(const Dial& dial, VGfloat value) {
    const VGPath needle = newPath();
    const VGfloat points[] = {-34, -5, 60, -3.4f, 146, -0.9f, 146, 0.9f, 60, 3.4f, -34, 5};
    vguPolygon(needle, points, 6, VG_TRUE);
    const VGfloat angle = firstAngle + sweep * value / dial.maximum;

    moveTo(dial.x + 4, dial.y - 7);  // its shadow
    vgRotate(angle);
    paints::fillOnce(needle, paints::solid(0x00000070));
    moveTo(dial.x, dial.y);
    vgRotate(angle);
    fill(needle,
         paints::linear(0, -4, 0, 4,
                        {{0, 0xff6a3dff}, {0.49f, 0xff6a3dff}, {0.51f, 0xe03418ff}, {1, 0xe03418ff}}));

    moveTo(dial.x, dial.y);
    fill(disc(2, -4, 25), paints::radial(2, -4, 2, -4, 25, {{0.7f, 0x00000090}, {1, 0x00000000}}));
    fill(disc(0, 0, 21), paints::linear(-15, 15, 15, -15, {{0, 0xe8edf2ff}, {1, 0x3a434eff}}));
    fill(disc(0, 0, 17), paints::radial(0, 0, -5, 6, 18, {{0, 0x4b5768ff}, {1, 0x0d1118ff}}));
}

/// Light on the glass: inside the face and above a big circle that lies lower.
void drawGlass(const Dial& dial) {
    moveTo(dial.x, dial.y);
    const VGPath face = disc(0, 0, faceRadius - 5), below = disc(60, -330, 400);
    vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 0, 0, width, height);
    vgRenderToMask(face, VG_FILL_PATH, VG_SET_MASK);
    vgRenderToMask(below, VG_FILL_PATH, VG_SUBTRACT_MASK);
    vgSeti(VG_MASKING, VG_TRUE);
    fill(face, paints::linear(-60, 170, 10, 40, {{0, 0xffffff5c}, {1, 0xffffff0a}}));
    vgSeti(VG_MASKING, VG_FALSE);
    vgDestroyPath(below);
}

void drawDial(const Dial& dial, VGfloat value, const digits::Digits& digits) {
    moveTo(dial.x, dial.y);
    drawFace(dial, digits);
    drawArcs(dial, value);
    const VGPaint ink = paints::solid(dial.light | 0xff);
    vgSetPaint(ink, VG_FILL_PATH);
    vgDestroyPaint(ink);
    digits.draw(std::to_string(int(std::lround(value * (dial.maximum < 10 ? 1000 : 1)))), 0, -70, 30);
    drawNeedle(dial, value);
    drawGlass(dial);
}

// ---- The middle ---------------------------------------------------------------------------------------

/// A bar of ten lights, lit up to `level` in [0, 1].
void drawBar(VGint x, VGint y, VGfloat level, VGuint low, VGuint high) {
    constexpr VGint barWidth = 22, barHeight = 150;
    moveTo(VGfloat(x), VGfloat(y));
    const VGPath lights = newPath();
    for (int i = 0; i < 10; ++i)
        vguRoundRect(lights, 0, 15 * VGfloat(i), VGfloat(barWidth), 12, 5, 5);
    paints::fillOnce(lights, paints::solid(0x1d2838ff));

    const VGint lit[] = {x, y, barWidth, VGint(std::lround(VGfloat(barHeight) * level))};
    vgSetiv(VG_SCISSOR_RECTS, 4, lit);
    vgSeti(VG_SCISSORING, VG_TRUE);
    fill(lights, paints::linear(0, 0, 0, VGfloat(barHeight), {{0, low}, {0.5f, 0xf7c948ff}, {1, high}}));
    vgSeti(VG_SCISSORING, VG_FALSE);
}

void drawArrow(VGfloat x, VGfloat y, VGfloat direction, bool lit) {
    const VGfloat points[] = {-16, 7, 0, 7, 0, 15, 18, 0, 0, -15, 0, -7, -16, -7};
    const VGPath arrow = newPath();
    vguPolygon(arrow, points, 7, VG_TRUE);
    moveTo(x, y);
    vgScale(direction, 1);
    vgSeti(VG_STROKE_JOIN_STYLE, VG_JOIN_ROUND);
    if (lit)
        paints::strokeOnce(arrow, paints::solid(0x3ddc8440), 9);
    paints::strokeOnce(arrow, paints::solid(lit ? 0x3ddc84ff : 0x24303fff), 3);
    fill(arrow, paints::solid(lit ? 0x3ddc84ff : 0x18212cff));
}

void drawHousing() {
    moveTo(0, 0);
    fill(roundRect(6, 6, width - 12, height - 12, 205),
         paints::linear(0, height, 0, 0, {{0, 0x39424eff}, {0.5f, 0x1b2129ff}, {1, 0x0c0f14ff}}));
    stroke(roundRect(8, 8, width - 16, height - 16, 203),
           paints::linear(0, height, 0, 0, {{0, 0x8c98a6ff}, {0.4f, 0x2b333dff}, {1, 0x05070aff}}), 3);
    fill(roundRect(418, 62, 124, 296, 26), paints::linear(0, 358, 0, 62, {{0, 0x05080dff}, {1, 0x101824ff}}));
    stroke(roundRect(418, 62, 124, 296, 26),
           paints::linear(0, 358, 0, 62, {{0, 0x000000ff}, {1, 0x4b5766ff}}), 2);
}

// ---- The drive ----------------------------------------------------------------------------------------

void draw(double seconds, const digits::Digits& digits) {
    const Dial speed{216, 210, 12, 20, 240, 200, 0x4fd1ffff, 0x3b6cf6ff};
    const Dial revolutions{744, 210, 8, 1, 8, 6.5f, 0xffd166ff, 0xf78c3bff};
    const VGfloat t = VGfloat(seconds);
    vgClear(0, 0, width, height);
    drawHousing();
    drawDial(speed, 120 - 100 * std::cos(0.5f * t), digits);
    drawDial(revolutions, 3.9f - 2.9f * std::cos(1.1f * t), digits);
    drawBar(446, 88, 0.8f - 0.02f * std::fmod(t, 30.0f), 0xe12d39ff, 0x3ddc84ff);
    drawBar(492, 88, 0.45f + 0.1f * std::sin(0.3f * t), 0x4fd1ffff, 0xe12d39ff);
    const bool blink = std::fmod(seconds, 1) < 0.5;
    drawArrow(450, 326, -1, false);
    drawArrow(510, 326, 1, blink);

    moveTo(0, 0);
    const VGPaint ink = paints::solid(0xb8c7d9ff);
    vgSetPaint(ink, VG_FILL_PATH);
    vgDestroyPaint(ink);
    digits.draw(std::to_string(int(48210 + seconds / 30)), 480, 274, 19);
}

}  // namespace

int main(int argc, char** argv) {
    return stage::run([&] {
        if (argc < 2 || argc > 3)
            throw std::runtime_error("usage: vg_gauges OUT.png|window [SECONDS]");
        const auto stage = stage::open(argv[1], width, height, "Gauges");
        const digits::Digits digits;
        const VGfloat room[] = {0.03f, 0.035f, 0.045f, 1};
        vgSetfv(VG_CLEAR_COLOR, 4, room);
        stage->show(argc > 2 ? std::atof(argv[2]) : 0, [&](double seconds) { draw(seconds, digits); });
    });
}

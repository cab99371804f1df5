#include "geometry/cubic.hpp"

namespace vtm::geometry {

namespace {

Point lerp(Point a, Point b, double t) { return a + (b - a) * t; }

/// Adds the points where a coordinate of the curve, with these control values, stands still inside ]0, 1[.
void addExtrema(const Cubic& c, int coordinate, Box& box) {
    const double p0 = c.p0[coordinate], p1 = c.p1[coordinate], p2 = c.p2[coordinate], p3 = c.p3[coordinate];
    const double a = p3 - 3 * p2 + 3 * p1 - p0, b = 2 * (p2 - 2 * p1 + p0), d = p1 - p0;
    const double discriminant = b * b - 4 * a * d;
    if (discriminant < 0)
        return;
    // The stable pair of roots: q / a and d / q. Divisions by zero give infinities, or NaN.
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (const double t : {q / a, d / q})
        if (t > 0 && t < 1)
            box.add(c.at(t));
}

}  // namespace

Cubic straightCubic(Point from, Point to) {
    return {from, lerp(from, to, 1.0 / 3), lerp(from, to, 2.0 / 3), to};
}

Cubic raised(Point from, Point control, Point to) {
    return {from, lerp(from, control, 2.0 / 3), lerp(to, control, 2.0 / 3), to};
}

Cubic part(const Cubic& c, double t0, double t1) {
    const double third = (t1 - t0) / 3;
    const Point a = t0 == 0 ? c.p0 : c.at(t0), b = t1 == 1 ? c.p3 : c.at(t1);
    return {a, a + c.derivative(t0) * third, b - c.derivative(t1) * third, b};
}

std::array<Cubic, 2> halves(const Cubic& c) {
    const Point a = lerp(c.p0, c.p1, 0.5), b = lerp(c.p1, c.p2, 0.5), d = lerp(c.p2, c.p3, 0.5);
    const Point ab = lerp(a, b, 0.5), bd = lerp(b, d, 0.5), middle = lerp(ab, bd, 0.5);
    return {Cubic{c.p0, a, ab, middle}, Cubic{middle, bd, d, c.p3}};
}

Box controlBox(const Cubic& c) {
    Box box;
    for (const Point p : {c.p0, c.p1, c.p2, c.p3})
        box.add(p);
    return box;
}

Box bounds(const Cubic& c) {
    Box box;
    box.add(c.p0);
    box.add(c.p3);
    addExtrema(c, 0, box);
    addExtrema(c, 1, box);
    return box;
}

}  // namespace vtm::geometry

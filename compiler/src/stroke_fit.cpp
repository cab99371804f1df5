// Hermite fit in the least-squares sense. End points and end tangents are given, which leaves the two
// arm lengths. Gauss-Newton moves them so that the residuals vanish in the mean, each residual taken
// along the normal of the sample it belongs to: as only the shape is compared and never the
// parametrisation, the error falls with the sixth power of the length (de Boor, Höllig, Sabin 1987).

#include "compiler/src/stroke_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Arms = glm::dvec2;
using Parameters = std::array<double, std::tuple_size_v<Samples>>;

/// The derivative with respect to the sample's index where a curve starts, from five samples.
Point startSlope(const Point& a, const Point& b, const Point& c, const Point& d, const Point& e) {
    return (-25.0 * a + 48.0 * b - 36.0 * c + 16.0 * d - 3.0 * e) / 12.0;
}

/// The Hermite cubic of the samples' own parametrisation.
Cubic initialCubic(const Samples& s) {
    const std::size_t n = s.size() - 1;
    const Point start = startSlope(s[0].at, s[1].at, s[2].at, s[3].at, s[4].at);
    const Point end = -startSlope(s[n].at, s[n - 1].at, s[n - 2].at, s[n - 3].at, s[n - 4].at);
    const double third = double(n) / 3;
    const double arm0 = std::max(0.0, glm::dot(start, s[0].tangent)) * third;
    const double arm1 = std::max(0.0, glm::dot(end, s[n].tangent)) * third;
    return {s[0].at, s[0].at + s[0].tangent * arm0, s[n].at - s[n].tangent * arm1, s[n].at};
}

Parameters evenParameters() {
    Parameters u{};
    for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = double(i) / double(u.size() - 1);
    return u;
}

/// Newton step towards the point of the cubic on the sample's normal. One is enough: the parameters stay
/// from one Gauss-Newton step to the next, and what is missing only makes the error look larger.
double project(const Cubic& c, const Sample& s, double u) {
    const double slope = glm::dot(derivativeAt(c, u), s.tangent);
    return slope > 0 ? std::clamp(u - glm::dot(pointAt(c, u) - s.at, s.tangent) / slope, 0.0, 1.0) : u;
}

/// Brings the parameters to the samples' normals. Largest distance of a sample from its point;
/// infinite if the order is lost.
double projectAll(const Samples& s, const Cubic& c, Parameters& u) {
    double error = 0;
    for (std::size_t i = 1; i + 1 < s.size(); ++i) {
        u[i] = project(c, s[i], u[i]);
        if (u[i] < u[i - 1])
            return infinity;
        error = std::max(error, glm::distance(pointAt(c, u[i]), s[i].at));
    }
    return error;
}

/// Gauss-Newton step of the two arms; zero where the samples do not determine them (a straight line).
Arms armStep(const Samples& s, const Cubic& c, const Parameters& u) {
    const Point t0 = s.front().tangent, t1 = s.back().tangent;
    double aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
    for (std::size_t i = 1; i + 1 < s.size(); ++i) {
        const Point normal = perp(s[i].tangent);
        const double v = 1 - u[i], residual = glm::dot(s[i].at - pointAt(c, u[i]), normal);
        const double a = 3 * v * v * u[i] * glm::dot(t0, normal),
                     b = -3 * v * u[i] * u[i] * glm::dot(t1, normal);
        aa += a * a, ab += a * b, bb += b * b, ar += a * residual, br += b * residual;
    }
    const double determinant = aa * bb - ab * ab;
    constexpr double singular = 1e-12;  // relative: beyond, the step would be rounding noise
    if (!(determinant > singular * (aa + bb) * (aa + bb)))
        return {0, 0};
    return {(ar * bb - br * ab) / determinant, (br * aa - ar * ab) / determinant};
}

}  // namespace

Fit fitCubic(const Samples& s, double tolerance) {
    Cubic cubic = initialCubic(s);
    Parameters u = evenParameters();
    Fit best{cubic, infinity};
    Arms arms{glm::distance(cubic.p0, cubic.p1), glm::distance(cubic.p3, cubic.p2)}, bestArms = arms;
    const double longest = 4 * glm::distance(cubic.p0, cubic.p3);
    constexpr int maxSteps = 7;  // three to four converge; the rest is for steps taken back
    for (int step = 0; step < maxSteps && best.error > tolerance; ++step) {
        const double error = projectAll(s, cubic, u);
        if (error < best.error) {
            best = {cubic, error};
            bestArms = arms;
            arms = glm::clamp(arms + armStep(s, cubic, u), Arms{0, 0}, Arms{longest, longest});
        } else {
            arms = (arms + 3.0 * bestArms) / 4.0;
            u = evenParameters();
        }
        cubic.p1 = cubic.p0 + s.front().tangent * arms.x;
        cubic.p2 = cubic.p3 - s.back().tangent * arms.y;
    }
    return best;
}

double chordError(const Samples& samples) {
    const Point from = samples.front().at, chord = samples.back().at - from;
    const double square = glm::dot(chord, chord);
    double error = 0;
    for (const Sample& s : samples) {
        const double along = square > 0 ? std::clamp(glm::dot(s.at - from, chord) / square, 0.0, 1.0) : 0;
        error = std::max(error, glm::distance(s.at, from + chord * along));
    }
    return error;
}

}  // namespace vtm::compiler::stroke

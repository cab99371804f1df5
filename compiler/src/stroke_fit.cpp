// Hermite fit in the least-squares sense. End points and end tangents are given, which leaves the two
// arm lengths. Gauss-Newton moves them so that the residuals vanish in the mean, each residual taken
// along the normal of the sample it belongs to: as only the shape is compared and never the
// parametrisation, the error falls with the sixth power of the length (de Boor, Höllig, Sabin 1987).

#include "compiler/src/stroke_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Parameters = std::array<double, std::tuple_size_v<Samples>>;

/// The arm that makes a circular arc of a chord whose tangents both leave it by `angle`:
/// 4/3·tan(angle/2)·R with R = chord / (2 sin angle).
double arcArm(double chord, double angle) { return 2 * chord / (3 * (1 + std::cos(angle))); }

Cubic initialCubic(const Samples& s) {
    const Sample &a = s.front(), &b = s.back();
    const Point chord = b.at - a.at;
    const double turn =
        (std::abs(angleBetween(chord, a.tangent)) + std::abs(angleBetween(chord, b.tangent))) / 2;
    constexpr double widest = 2.1;  // 120°: beyond it the formula grows without bound
    const double arm = arcArm(glm::length(chord), std::min(turn, widest));
    return {a.at, a.at + a.tangent * arm, b.at - b.tangent * arm, b.at};
}

Parameters chordLengthParameters(const Samples& s) {
    Parameters u{};
    for (std::size_t i = 1; i < s.size(); ++i)
        u[i] = u[i - 1] + glm::distance(s[i - 1].at, s[i].at);
    for (double& value : u)
        value /= u.back();
    return u;
}

/// Newton for the point of the cubic on the sample's normal.
double project(const Cubic& c, const Sample& s, double u) {
    constexpr int steps = 2;  // from a neighbouring solution: quadratic convergence does the rest
    for (int i = 0; i < steps; ++i) {
        const double slope = glm::dot(derivativeAt(c, u), s.tangent);
        if (slope > 0)
            u = std::clamp(u - glm::dot(pointAt(c, u) - s.at, s.tangent) / slope, 0.0, 1.0);
    }
    return u;
}

/// One Gauss-Newton step on the arms; false where the samples do not determine them (a straight line).
bool improveArms(const Samples& s, Parameters& u, Cubic& c) {
    const Point t0 = s.front().tangent, t1 = s.back().tangent;
    double aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
    for (std::size_t i = 1; i + 1 < s.size(); ++i) {
        u[i] = project(c, s[i], u[i]);
        const Point normal = perp(s[i].tangent);
        const double v = 1 - u[i], residual = glm::dot(s[i].at - pointAt(c, u[i]), normal);
        const double a = 3 * v * v * u[i] * glm::dot(t0, normal),
                     b = -3 * v * u[i] * u[i] * glm::dot(t1, normal);
        aa += a * a, ab += a * b, bb += b * b, ar += a * residual, br += b * residual;
    }
    const double determinant = aa * bb - ab * ab;
    constexpr double singular = 1e-12;  // relative; samples on a line to six digits say nothing about arms
    if (!(determinant > singular * (aa + bb) * (aa + bb)))
        return false;
    const double arm0 = glm::distance(c.p0, c.p1) + (ar * bb - br * ab) / determinant;
    const double arm1 = glm::distance(c.p3, c.p2) + (br * aa - ar * ab) / determinant;
    const double longest = 4 * glm::distance(c.p0, c.p3);
    c.p1 = c.p0 + t0 * std::clamp(arm0, 0.0, longest);
    c.p2 = c.p3 - t1 * std::clamp(arm1, 0.0, longest);
    return true;
}

double fitError(const Samples& s, Parameters u, const Cubic& c) {
    double error = 0;
    for (std::size_t i = 1; i + 1 < s.size(); ++i) {
        u[i] = project(c, s[i], u[i]);
        if (u[i] < u[i - 1])
            return infinity;
        error = std::max(error, glm::distance(pointAt(c, u[i]), s[i].at));
    }
    return error;
}

}  // namespace

Fit fitCubic(const Samples& samples) {
    if (samples.front().at == samples.back().at)
        return {{}, infinity};
    Cubic cubic = initialCubic(samples);
    Parameters u = chordLengthParameters(samples);
    constexpr int steps = 4;  // the arc's arms are within a few percent for what passes in the end
    for (int i = 0; i < steps && improveArms(samples, u, cubic); ++i) {
    }
    return {cubic, fitError(samples, u, cubic)};
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

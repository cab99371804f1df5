// Hermite fit in the least-squares sense. End points and end tangents are given, which leaves the two
// arm lengths. Gauss-Newton moves them so that the residuals vanish in the mean, each residual taken
// along the normal of the sample it belongs to: as only the shape is compared and never the
// parametrisation, the error falls with the sixth power of the length (de Boor, Höllig, Sabin 1987).

#include "compiler/stroke/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace vtm::compiler::stroke {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Arms = glm::dvec2;

/// One number for each inner sample.
constexpr std::size_t innerSamples = std::tuple_size_v<Samples> - 2;
using Row = std::array<double, innerSamples>;

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

Row evenParameters() {
    Row u{};
    for (std::size_t i = 0; i < innerSamples; ++i)
        u[i] = double(i + 1) / double(innerSamples + 1);
    return u;
}

/// The inner samples by coordinates, seen from the first sample, for loops that do several at once.
struct Rows {
    Row x, y, tangentX, tangentY;
    Row turn0, turn1;  ///< first and last tangent along the sample's normal

    explicit Rows(const Samples& s) {
        for (std::size_t i = 0; i < innerSamples; ++i) {
            const Sample& sample = s[i + 1];
            x[i] = sample.at.x - s.front().at.x, y[i] = sample.at.y - s.front().at.y;
            tangentX[i] = sample.tangent.x, tangentY[i] = sample.tangent.y;
            turn0[i] = cross(sample.tangent, s.front().tangent);
            turn1[i] = cross(sample.tangent, s.back().tangent);
        }
    }
};

/// One coordinate of a cubic by powers of its parameter, seen from its start.
struct Powers {
    double c1, c2, c3;

    Powers(double p0, double p1, double p2, double p3)
        : c1(3 * (p1 - p0)), c2(3 * (p2 - p1) - c1), c3(p3 - p0 - 3 * (p2 - p1)) {}
    double at(double u) const { return ((c3 * u + c2) * u + c1) * u; }
    double slope(double u) const { return (3 * c3 * u + 2 * c2) * u + c1; }
};

/// The error of a cubic, and the Gauss-Newton step of its arms that would lessen it.
struct Residuals {
    double error;  ///< largest distance of a sample from its point; infinite if the order is lost
    Arms step;     ///< zero where the samples do not determine the arms (a straight line)
};

/// Brings the parameters to the samples' normals by one step of Newton's. One is enough: the parameters
/// stay from one Gauss-Newton step to the next, and what is missing only makes the error look larger.
Residuals project(const Rows& s, const Cubic& cubic, Row& u) {
    const Powers x(cubic.p0.x, cubic.p1.x, cubic.p2.x, cubic.p3.x),
        y(cubic.p0.y, cubic.p1.y, cubic.p2.y, cubic.p3.y);
    Row squares, residuals;
    for (std::size_t i = 0; i < innerSamples; ++i) {
        const double tx = s.tangentX[i], ty = s.tangentY[i];
        const double slope = x.slope(u[i]) * tx + y.slope(u[i]) * ty;
        const double ahead = (x.at(u[i]) - s.x[i]) * tx + (y.at(u[i]) - s.y[i]) * ty;
        const double next = u[i] - ahead / slope;
        u[i] = std::clamp(slope > 0 ? next : u[i], 0.0, 1.0);
        const double offX = s.x[i] - x.at(u[i]), offY = s.y[i] - y.at(u[i]);
        squares[i] = offX * offX + offY * offY;
        residuals[i] = tx * offY - ty * offX;
    }
    double square = 0, aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
    for (std::size_t i = 0; i < innerSamples; ++i) {
        if (i > 0 && u[i] < u[i - 1])
            return {infinity, {0, 0}};
        const double v = 1 - u[i];
        const double a = 3 * v * v * u[i] * s.turn0[i], b = -3 * v * u[i] * u[i] * s.turn1[i];
        square = std::max(square, squares[i]);
        aa += a * a, ab += a * b, bb += b * b, ar += a * residuals[i], br += b * residuals[i];
    }
    const double determinant = aa * bb - ab * ab;
    constexpr double singular = 1e-12;  // relative: beyond, the step would be rounding noise
    if (!(determinant > singular * (aa + bb) * (aa + bb)))
        return {std::sqrt(square), {0, 0}};
    return {std::sqrt(square), {(ar * bb - br * ab) / determinant, (br * aa - ar * ab) / determinant}};
}

}  // namespace

Fit fitCubic(const Samples& s, double tolerance) {
    Cubic cubic = initialCubic(s);
    const Rows rows(s);
    Row u = evenParameters();
    Fit best{cubic, infinity};
    Arms arms{glm::distance(cubic.p0, cubic.p1), glm::distance(cubic.p3, cubic.p2)}, bestArms = arms;
    const double longest = 4 * glm::distance(cubic.p0, cubic.p3);
    constexpr int maxSteps = 7;      // three to four converge; the rest is for steps taken back
    constexpr double stays = 0.97;   // a step that lessens the error by no more is the last
    constexpr int trialSteps = 3;    // by then a fit that will do is near
    constexpr double hopeless = 16;  // tolerances
    for (int step = 0; step < maxSteps && best.error > tolerance; ++step) {
        const Residuals now = project(rows, cubic, u);
        if (step >= trialSteps && std::min(now.error, best.error) > hopeless * tolerance)
            return now.error < best.error ? Fit{cubic, now.error} : best;
        if (now.error < best.error) {
            if (now.error > stays * best.error)
                return {cubic, now.error};
            best = {cubic, now.error};
            bestArms = arms;
            arms = glm::clamp(arms + now.step, Arms{0, 0}, Arms{longest, longest});
        } else {
            arms = (arms + 3.0 * bestArms) / 4.0;
            u = evenParameters();
        }
        cubic.p1 = cubic.p0 + s.front().tangent * arms.x;
        cubic.p2 = cubic.p3 - s.back().tangent * arms.y;
    }
    return best;
}

bool isChord(const Samples& samples, double tolerance) {
    const Point from = samples.front().at, chord = samples.back().at - from;
    const double square = glm::dot(chord, chord);
    const auto isNear = [&](const Sample& s) {
        const double along = square > 0 ? std::clamp(glm::dot(s.at - from, chord) / square, 0.0, 1.0) : 0;
        const Point off = s.at - from - chord * along;
        return glm::dot(off, off) <= tolerance * tolerance;
    };
    return isNear(samples[samples.size() / 2]) && std::all_of(samples.begin(), samples.end(), isNear);
}

}  // namespace vtm::compiler::stroke

#include "paper/compile/fit.hpp"
#include "paper/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace vtm::paper {

namespace {

using glm::dvec2;

std::array<std::uint16_t, 2> quantise(dvec2 p) {
    const auto one = [](double v) {
        return std::uint16_t(std::lround(std::clamp(v, 0.0, 1.0) * cellExtent));
    };
    return {one(p.x), one(p.y)};
}

dvec2 decode(const std::array<std::uint16_t, 2>& p) { return dvec2(p[0], p[1]) / cellExtent; }

/// A polyline's points with this many between each two: a cubic through the vertices alone may
/// leave the chords between them.
constexpr int pointsAChord = 4;

template <class Visit>
void forEachPoint(std::span<const dvec2> points, Visit&& visit) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        for (int k = 0; k < pointsAChord; ++k)
            visit(points[i] + (points[i + 1] - points[i]) * (double(k) / pointsAChord));
    visit(points.back());
}

/// The local basis (A, AB, AB⊥).
struct Basis {
    dvec2 origin, along, across;
    dvec2 operator()(dvec2 p) const { return {glm::dot(p - origin, along), glm::dot(p - origin, across)}; }
};

/// Normal equations of v = mA u (1-u)² - mB u² (1-u).
struct SlopeFit {
    double aa = 0, ab = 0, bb = 0, av = 0, bv = 0;

    void add(dvec2 p) {
        const double u = p.x, w = 1 - u, a = u * w * w, b = -u * u * w;
        aa += a * a, ab += a * b, bb += b * b, av += a * p.y, bv += b * p.y;
    }
    dvec2 solve() const {
        const double determinant = aa * bb - ab * ab;
        // Points only near the ends say nothing about slopes: take the chord.
        if (!(determinant > 1e-12 * aa * bb))
            return dvec2(0);
        return dvec2(av * bb - bv * ab, bv * aa - av * ab) / determinant;
    }
};

std::int16_t storedSlope(double m) { return std::int16_t(std::lround(m * slopeScale)); }

bool liesAlong(const Piece& piece, const Basis& basis, double length, std::span<const dvec2> points,
               double tolerance) {
    const double slack = tolerance / length;
    double reached = 0;
    bool good = true;
    forEachPoint(points, [&](dvec2 p) {
        const double u = basis(p).x;
        good = good && u >= reached - slack && u <= 1 + slack &&
               std::abs(implicitValue(piece, p).value) <= slack;
        reached = std::max(reached, u);
    });
    return good;
}

bool allNear(std::span<const dvec2> points, dvec2 centre, double tolerance) {
    return std::ranges::all_of(points, [&](dvec2 p) { return glm::distance(p, centre) <= tolerance; });
}

}  // namespace

std::optional<Piece> fitPiece(std::span<const dvec2> points, double tolerance) {
    Piece piece{quantise(points.front()), quantise(points.back()), 0, 0};
    const dvec2 a = decode(piece.a), chord = decode(piece.b) - a;
    if (piece.a == piece.b)
        return allNear(points, a, tolerance) ? std::optional(piece) : std::nullopt;
    const double length = glm::length(chord);
    const dvec2 along = chord / (length * length);
    const Basis basis{a, along, {-along.y, along.x}};
    if (points.size() > 2) {
        SlopeFit fit;
        forEachPoint(points, [&](dvec2 p) { fit.add(basis(p)); });
        const dvec2 slopes = fit.solve();
        if (!(std::abs(slopes.x) <= largestSlope && std::abs(slopes.y) <= largestSlope))
            return std::nullopt;
        piece.slopeA = storedSlope(slopes.x);
        piece.slopeB = storedSlope(slopes.y);
    }
    return liesAlong(piece, basis, length, points, tolerance) ? std::optional(piece) : std::nullopt;
}

namespace {

/// The longest beginning of at least one chord that fits: found by doubling, then by halving.
std::size_t longestChords(std::span<const dvec2> points, double tolerance) {
    const std::size_t all = points.size() - 1;
    const auto fits = [&](std::size_t chords) {
        return fitPiece(points.first(chords + 1), tolerance).has_value();
    };
    if (fits(all))
        return all;
    std::size_t good = 1, bad = 2;
    while (bad < all && fits(bad))
        good = bad, bad = std::min(2 * bad, all);
    while (bad - good > 1) {
        const std::size_t middle = (good + bad) / 2;
        (fits(middle) ? good : bad) = middle;
    }
    return good;
}

}  // namespace

std::vector<Piece> fitPieces(std::span<const dvec2> points, double tolerance, std::size_t limit) {
    std::vector<Piece> pieces;
    while (points.size() > 1 && pieces.size() <= limit) {
        const std::size_t chords = longestChords(points, tolerance);
        const auto piece = fitPiece(points.first(chords + 1), tolerance);
        if (piece && piece->a != piece->b)
            pieces.push_back(*piece);
        points = points.subspan(chords);
    }
    return pieces;
}

}  // namespace vtm::paper

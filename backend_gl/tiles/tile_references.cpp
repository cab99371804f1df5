#include "backend_gl/tiles/tile_references.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace vtm::gl {

namespace {

using asset::cross;
using glm::dvec2;

constexpr double step = 1.0 / (1u << tileStepLog2);
constexpr dvec2 shift = dvec2(referenceShiftX, referenceShiftY) * step;

/// How far a point is from being on the other side of a piece's curve or chord.
double clearance2(const PlanarPiece& p, dvec2 point) {
    const dvec2 d = p.b - p.a;
    const double length2 = glm::dot(d, d);
    double clear = distance2(p.a, d, 1 / length2, point);
    const dvec2 q = point - p.a;
    if (const double s = glm::dot(q, d) / length2; s > 0 && s < 1) {
        const double gap = cross(d, q) / length2 - p.height(s);
        clear = std::min(clear, gap * gap * length2);
    }
    return clear;
}

/// The first place that is this share of a cell away from all pieces is taken, else the one furthest away.
constexpr double goodClearance = 1.0 / 16;

/// Rounding moves ends by sqrt(1/2) of a step, slopes of 12 bits a curve by 7e-5 of its length, which is at
/// most 0.75: 3.4 steps; and what is smaller than a step vanishes. A lattice row is no more than a step.
constexpr double surelyClear = 8 * step;
/// Points that are tried. A square in which none of them is clear has thousands of pieces.
constexpr int tries = 256;

/// The i-th point of a sequence that fills the unit square evenly (Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences"), from its middle.
dvec2 spread(int i) { return glm::fract(0.5 + double(i) * dvec2(0.7548776662466927, 0.5698402909980532)); }

}  // namespace

double distance2(dvec2 a, dvec2 d, double inverseLength2, dvec2 point) {
    const dvec2 q = point - a;
    const dvec2 gap = q - std::clamp(glm::dot(q, d) * inverseLength2, 0.0, 1.0) * d;
    return glm::dot(gap, gap);
}

Reference referenceIn(int column, int row, const std::vector<PlanarPiece>& pieces,
                      std::span<const std::uint32_t> list) {
    // From the middle outwards.
    static constexpr std::array<unsigned, 16> order{5, 10, 6, 9, 0, 15, 3, 12, 1, 14, 2, 13, 4, 11, 7, 8};
    Reference best;
    double bestClearance = -1;
    for (const unsigned place : order) {
        const dvec2 inCell = (dvec2(place % 4, place / 4) + 0.5) / 4.0;
        const dvec2 point = (dvec2(column, row) + inCell) * cellSize + shift;
        double clear = cellSize * cellSize;
        for (const std::uint32_t i : list)
            clear = std::min(clear, clearance2(pieces[i], point));
        if (clear > bestClearance) {
            best = {point, place, 0};
            bestClearance = clear;
        }
        if (clear >= cellSize * cellSize * goodClearance * goodClearance)
            break;
    }
    return best;
}

std::optional<dvec2> clearPoint(const LocalPieces& local, double side,
                                std::span<const PlanarPiece* const> near) {
    std::vector<PlanarPiece> pieces;
    for (const PlanarPiece* piece : near) {
        const PlanarPiece p = local.toTile(*piece);
        const double reach = surelyClear + p.bulge();
        const dvec2 minimum = glm::min(p.a, p.b) - reach, maximum = glm::max(p.a, p.b) + reach;
        if (minimum.x <= side && minimum.y <= side && maximum.x >= 0 && maximum.y >= 0)
            pieces.push_back(p);
    }
    for (int i = 0; i < tries; ++i) {
        const dvec2 point = spread(i) * side;
        if (std::ranges::all_of(pieces, [&](const PlanarPiece& p) {
                return clearance2(p, point) > surelyClear * surelyClear;
            }))
            return point;
    }
    return std::nullopt;
}

}  // namespace vtm::gl

#include "backend_gl/tiles/tile_cells.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <vtm/limits/limits.hpp>
#include "backend_gl/tiles/tile_pieces.hpp"

namespace vtm::gl {

namespace {

std::uint32_t steps(double coordinate) {
    return std::uint32_t(std::lround(std::ldexp(coordinate + 1, tileStepLog2)));
}

/// Fields from the lowest bit of the first word on.
class Packer {
public:
    void add(std::uint32_t value, unsigned bits) {
        const std::uint64_t shifted = (value & ((std::uint64_t(1) << bits) - 1)) << (used_ % 32);
        words_[used_ / 32] |= std::uint32_t(shifted);
        if (used_ % 32 + bits > 32)
            words_[used_ / 32 + 1] |= std::uint32_t(shifted >> 32);
        used_ += bits;
    }
    Texel words() const { return words_; }

private:
    Texel words_{};
    unsigned used_ = 0;
};

}  // namespace

Texel colorTexel(const PaintWords& left, const PaintWords& right) {
    return {left[0], left[1], right[0], right[1]};
}

Texel withColor(Texel cell, const PaintWords& paint) { return {cell[0], paint[0], paint[1], cell[3]}; }

namespace {

Texel geometryTexel(const PlanarPiece& piece, std::uint32_t pairTexel) {
    Packer packer;
    for (const double v : {piece.a.x, piece.a.y, piece.b.x, piece.b.y})
        packer.add(steps(v), tileCoordinateBits);
    for (const double slope : {piece.slopeA, piece.slopeB})
        packer.add(std::uint32_t(slopeSteps(slope)), 12);
    packer.add(pairTexel << 2, 32);
    return packer.words();
}

/// GLSL wants numbers.
std::uint32_t finiteBits(float value) {
    return std::bit_cast<std::uint32_t>(std::min(value, std::numeric_limits<float>::max()));
}

std::uint32_t sidesOf(const PlanarPiece& piece, glm::dvec2 point) {
    const asset::Sides at = piece.sidesOf(point);
    return (at.leftOfCurve ? leftOfCurveBit : 0) | (at.leftOfChord ? leftOfChordBit : 0);
}

}  // namespace

CellWriter::CellWriter(const TileWords& words, std::span<const asset::PaintChange> changes,
                       const std::vector<PlanarPiece>& pieces, std::vector<Texel>& texels)
    : words_(words), pieces_(pieces), texels_(texels) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> pairs;  // texels
    for (const PlanarPiece& piece : pieces)
        pairs.try_emplace({piece.left, piece.right});
    for (auto& [paints, texel] : pairs) {
        const auto [left, right] = paints;
        texel = std::uint32_t(texels.size());
        texels.push_back(colorTexel(words.of(left), words.of(right)));
        texels.push_back({left | right << 16, finiteBits(changes[left].steepness),
                          finiteBits(changes[right].steepness), 0});
    }
    for (const PlanarPiece& piece : pieces) {
        limits::check();
        geometry_.push_back(geometryTexel(piece, pairs.at({piece.left, piece.right})));
    }
    pairs_ = std::uint32_t(pairs.size());
}

Texel CellWriter::write(const Reference& reference, std::span<const std::uint32_t> list) {
    Texel cell = withoutList(reference);
    const auto length = std::uint32_t(list.size());
    cell[0] |= (length & ((1u << lowLengthBits) - 1)) << lengthShift;
    cell[3] = std::uint32_t(texels_.size()) | length >> lowLengthBits << firstTexelBits;
    for (const std::uint32_t i : list) {
        Texel texel = geometry_[i];
        texel[3] |= sidesOf(pieces_[i], reference.point);
        texels_.push_back(texel);
    }
    return cell;
}

Texel CellWriter::writeCrowded(const Reference& reference) const {
    Texel cell = withoutList(reference);
    cell[0] |= crowdedBit;
    return cell;
}

Texel CellWriter::withoutList(const Reference& reference) const {
    return withColor({reference.paint | reference.place << 16, 0, 0, 0}, words_.of(reference.paint));
}

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

Reference referenceIn(const CellGrid& grid, int column, int row, const std::vector<PlanarPiece>& pieces,
                      std::span<const std::uint32_t> list) {
    // From the middle outwards.
    static constexpr std::array<unsigned, 16> order{5, 10, 6, 9, 0, 15, 3, 12, 1, 14, 2, 13, 4, 11, 7, 8};
    const double cellSize = grid.cellSize();
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

std::optional<dvec2> clearPoint(const LocalPieces& local, double side, double more,
                                std::span<const PlanarPiece* const> near) {
    const double clear = surelyClear + more;
    std::vector<PlanarPiece> pieces;
    for (const PlanarPiece* piece : near) {
        const PlanarPiece p = local.toTile(*piece);
        const double reach = clear + p.bulge();
        const dvec2 minimum = glm::min(p.a, p.b) - reach, maximum = glm::max(p.a, p.b) + reach;
        if (minimum.x <= side && minimum.y <= side && maximum.x >= 0 && maximum.y >= 0)
            pieces.push_back(p);
    }
    for (int i = 0; i < tries; ++i) {
        const dvec2 point = spread(i) * side;
        if (std::ranges::all_of(pieces,
                                [&](const PlanarPiece& p) { return clearance2(p, point) > clear * clear; }))
            return point;
    }
    return std::nullopt;
}

namespace {

/// tile_fragment.glsl: one loop, of a turn a reference. Where half as many pieces as would do meet, their
/// roundings add up to what is seen.
constexpr std::uint64_t turnsPerPiece = 2;
/// One at least, and one to find the end.
constexpr std::uint64_t turnsOfEnds = 2;

/// tile_programs_fragment.glsl: the pixel and its quarters.
constexpr std::uint64_t partCount = 5;
/// A turn of the outer loop takes one of the inner loop at least, even if it adds no piece.
constexpr std::uint64_t outerTurns = 2;

/// Of a share of a paint: it is shaded once for the pixel and, where it is steep, for each quarter.
std::uint64_t paintTurns(const PaintCosts& costs, std::uint32_t paint) {
    return (outerTurns + costs.turns[paint]) * (costs.mayBeSteep(paint) ? partCount : 1);
}

}  // namespace

std::uint64_t solidTurns(std::size_t pieces) { return turnsPerPiece * pieces + turnsOfEnds; }

/// A share is shaded when two other paints have come after it. What comes is the first paint, and those of
/// each run of pieces between the same two; a pixel for which some pieces do not matter sees no more of such
/// runs. At its end each part takes one outer turn more, which may shade nothing.
std::uint64_t turnsWithPrograms(const PaintCosts& costs, std::uint32_t paint,
                                const std::vector<asset::PlanarPiece>& pieces,
                                std::span<const std::uint32_t> list) {
    std::uint64_t sum = outerTurns * partCount + paintTurns(costs, paint);
    bool steep = false;
    const asset::PlanarPiece* last = nullptr;
    for (const std::uint32_t i : list) {
        const asset::PlanarPiece& piece = pieces[i];
        if (!last || std::minmax(piece.left, piece.right) != std::minmax(last->left, last->right))
            sum += paintTurns(costs, piece.left) + paintTurns(costs, piece.right);
        steep = steep || costs.mayBeSteep(piece.left) || costs.mayBeSteep(piece.right);
        last = &piece;
    }
    return sum + list.size() * (steep ? partCount : 1);
}

}  // namespace vtm::gl

#include "raster/planar_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

#include "asset/instances.hpp"
#include "raster/map_part.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;

}  // namespace

std::uint32_t paintBehind(std::uint32_t paint, std::span<const Change> changes) {
    if (changes.size() == 1)
        return changes[0].after;
    for (const Change& candidate : changes) {
        int net = 0;
        for (const Change& change : changes)
            net += int(change.after == candidate.after) - int(change.before == candidate.after);
        if (net > 0)
            return candidate.after;
    }
    return paint;
}

PlanarPiece planarPiece(const Piece& piece) {
    return {dvec2(piece.a[0], piece.a[1]),
            dvec2(piece.b[0], piece.b[1]),
            piece.slopeA / double(slopeScale),
            piece.slopeB / double(slopeScale),
            piece.left,
            piece.right};
}

dvec2 PlanarPiece::at(double s) const {
    const dvec2 d = b - a;
    return s == 1 ? b : a + s * d + height(s) * dvec2(-d.y, d.x);
}

dvec2 PlanarPiece::derivative(double s) const {
    const dvec2 d = b - a;
    return d + slope(s) * dvec2(-d.y, d.x);
}

Sides PlanarPiece::sidesOf(dvec2 point) const {
    const dvec2 d = b - a, q = point - a;
    const double length2 = glm::dot(d, d), s = glm::dot(q, d) / length2, t = cross(d, q) / length2;
    const bool above = t > 0;
    return {above, s > 0 && s < 1 ? t > height(s) : above};
}

double PlanarPiece::bulge() const {
    // max of s (1 - s)² over [0, 1] is 4/27.
    return 4.0 / 27 * (std::abs(slopeA) + std::abs(slopeB)) * glm::length(b - a);
}

PlanarMap planarMap(const AssetView& asset, const Map& map) {
    MapPart whole = mapPart(asset, {}, map.root);
    PlanarMap result{{{map.x, map.y}, map.side}, std::move(whole.pieces)};
    std::ranges::copy(seams(std::move(whole.borders)), std::back_inserter(result.pieces));
    return result;
}

// ---- Placed maps ----------------------------------------------------------------------------------

namespace {

/// A shear moves a curve's points along its chord; without one, or where the curve is this flat, the image of
/// a piece is a piece.
constexpr double flatSlope = 0x1p-7;
/// Else it is cut into so many. Of a part with slopes up to tan 22.5°, what the cubic through its ends with
/// their tangents is off by is below (1/8)^4 / 4 < 2^-14 of the whole chord.
constexpr int shearedParts = 8;

/// The pieces of a placed map, in lattice coordinates of the one around.
class Placing {
public:
    Placing(const PlacedMap& placed, double innerExtent, const MapPlace& outer,
            std::vector<PlanarPiece>& pieces)
        : paints_(placed.paints), pieces_(pieces) {
        const double scale = outer.extent / outer.side;
        toOuter_ = {placed.toPicture.linear * (scale / innerExtent),
                    (placed.toPicture.offset - outer.origin) * scale};
        isMirrored_ = glm::determinant(toOuter_.linear) < 0;
    }

    void add(const PlanarPiece& piece) {
        const std::uint32_t left = paints_(isMirrored_ ? piece.right : piece.left),
                            right = paints_(isMirrored_ ? piece.left : piece.right);
        if (left == right)
            return;
        const dvec2 d = piece.b - piece.a, chord = toOuter_.linear * d,
                    across = toOuter_.linear * dvec2(-d.y, d.x);
        const double length2 = glm::dot(chord, chord);
        if (length2 == 0)
            return;
        const double shear = glm::dot(across, chord) / length2;
        const double steepest = std::max(std::abs(piece.slopeA), std::abs(piece.slopeB));
        const int parts = std::abs(shear) * steepest * steepest <= flatSlope * flatSlope ? 1 : shearedParts;
        dvec2 from = toOuter_(piece.a);
        for (int i = 0; i < parts; ++i) {
            const double s0 = double(i) / parts, s1 = double(i + 1) / parts;
            const dvec2 to = toOuter_(piece.at(s1));
            const dvec2 part = to - from;
            const auto slopeAt = [&](double s) {
                const dvec2 tangent = toOuter_.linear * piece.derivative(s);
                return cross(part, tangent) / glm::dot(part, tangent);
            };
            const bool isStraight = piece.slopeA == 0 && piece.slopeB == 0;
            const PlanarPiece placed{glm::round(from),
                                     glm::round(to),
                                     isStraight ? 0 : slopeAt(s0),
                                     isStraight ? 0 : slopeAt(s1),
                                     left,
                                     right};
            if (placed.a != placed.b)
                pieces_.push_back(placed);
            from = to;
        }
    }

private:
    const PlacedPaints& paints_;
    std::vector<PlanarPiece>& pieces_;
    Affine2 toOuter_;
    bool isMirrored_;
};

}  // namespace

PlanarMap flatPlanarMap(const AssetView& asset, const Map& map) {
    PlanarMap flat = planarMap(asset, map);
    if (map.instances == 0)
        return flat;
    std::vector<std::optional<PlanarMap>> inner(asset.maps.size());
    forEachMap(asset, map, [&](const PlacedMap& placed) {
        if (&placed.map == &map)
            return true;
        std::optional<PlanarMap>& of = inner[std::size_t(&placed.map - asset.maps.data())];
        if (!of)
            of = planarMap(asset, placed.map);
        limits::need(of->pieces.size() * sizeof(PlanarPiece));
        Placing placing(placed, of->extent, flat, flat.pieces);
        for (const PlanarPiece& piece : of->pieces)
            placing.add(piece);
        return true;
    });
    return flat;
}

void requireSumOfMaps(const AssetView& asset) {
    if (!isSumOfMaps(asset))
        throw std::invalid_argument("only assets of exact mode have a planar map");
}

std::vector<PlanarMap> planarMaps(const AssetView& asset) {
    requireSumOfMaps(asset);
    std::vector<PlanarMap> maps;
    for (const Command& command : asset.commands)
        maps.push_back(flatPlanarMap(asset, asset.maps[command.map]));
    return maps;
}

// ---- Points ---------------------------------------------------------------------------------------

/// The point's side of the chord is asked
/// for once: where rounding turns it, both of what follows from it turn.
void addChanges(const PlanarPiece& piece, dvec2 point, std::vector<Change>& changes) {
    const bool aIsBelow = piece.a.y <= point.y, bIsBelow = piece.b.y <= point.y;
    const Sides at = piece.sidesOf(point);
    // The chord lies between the row's left end and the point.
    if (aIsBelow != bIsBelow && at.leftOfChord != aIsBelow)
        changes.push_back(aIsBelow ? Change{0, piece.left, piece.right} : Change{0, piece.right, piece.left});
    if (at.leftOfCurve != at.leftOfChord)
        changes.push_back(
            {0, at.leftOfChord ? piece.left : piece.right, at.leftOfCurve ? piece.left : piece.right});
}

namespace {

/// Rows for so many pieces: a piece of a picture of many is short, so it is in few of them.
std::size_t rowsFor(std::size_t pieces) { return std::size_t(4 * std::sqrt(double(pieces))) + 1; }

}  // namespace

std::size_t PlanarIndex::rowOf(double y) const {
    return std::size_t(std::clamp(y / map_.extent * double(rows_), 0.0, double(rows_ - 1)));
}

PlanarIndex::PlanarIndex(PlanarMap map)
    : map_(std::move(map)), rows_(rowsFor(map_.pieces.size())), firsts_(rows_ + 1) {
    const auto forEachRow = [&](const PlanarPiece& p, auto&& visit) {
        const double bulge = p.bulge();
        const std::size_t last = rowOf(std::max(p.a.y, p.b.y) + bulge);
        for (std::size_t row = rowOf(std::min(p.a.y, p.b.y) - bulge); row <= last; ++row)
            visit(row);
    };
    for (const PlanarPiece& p : map_.pieces)
        forEachRow(p, [&](std::size_t row) { ++firsts_[row + 1]; });
    std::partial_sum(firsts_.begin(), firsts_.end(), firsts_.begin());
    numbers_.resize(firsts_.back());
    std::vector<std::uint32_t> next(firsts_.begin(), firsts_.end() - 1);
    for (std::uint32_t i = 0; i < map_.pieces.size(); ++i)
        forEachRow(map_.pieces[i], [&](std::size_t row) { numbers_[next[row]++] = i; });
}

std::uint32_t PlanarIndex::paintAt(dvec2 point) const {
    if (!(point.x >= 0 && point.y >= 0 && point.x <= map_.extent && point.y <= map_.extent))
        return 0;
    point = belowTop(point, map_.extent);
    const std::size_t row = rowOf(point.y);
    std::vector<Change> changes;
    for (std::uint32_t i = firsts_[row]; i < firsts_[row + 1]; ++i)
        addChanges(map_.pieces[numbers_[i]], point, changes);
    return paintBehind(0, changes);
}

}  // namespace vtm::asset

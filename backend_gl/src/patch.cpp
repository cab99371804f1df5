#include "backend_gl/src/patch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace vtm::gl {

namespace {

using asset::Change;
using asset::cross;
using asset::latticeExtent;
using asset::Sides;
using asset::Texel;
using glm::dvec2;

/// Cells a side.
constexpr int cellCount = 1 << patchCellsLog2;
constexpr double cellSize = 1.0 / cellCount;

/// A piece longer than this many patches is cut into parts, so that end points within reach lie in [-1, 3)
/// and slopes of 12 bits place the curve within 4/27 · 2 / 4094 = 7e-5 of its length.
constexpr double longestPiece = 0.75, longestPart = 0.5;
/// Into at least so many: the part of a cubic over its own chord is a cubic no more, but within L (1/8)^4 · 4
/// / 384 = 2.5e-6 of the length L.
constexpr double fewestParts = 8;

/// What a curve may leave its tangent by within a pixel, in pixels: the shader looks for the ends of the part
/// in the box on the tangent, and what it misses there is about the square of that.
constexpr double flatEnough = 0.006;

/// Squared distance from a point to a chord.
double distance2(dvec2 a, dvec2 d, double inverseLength2, dvec2 point) {
    const dvec2 q = point - a;
    const dvec2 gap = q - std::clamp(glm::dot(q, d) * inverseLength2, 0.0, 1.0) * d;
    return glm::dot(gap, gap);
}

/// The part [s0, s1], by its ends and tangents.
PlanarPiece partOf(const PlanarPiece& p, double s0, double s1) {
    PlanarPiece part = p;
    part.a = p.at(s0);
    part.b = p.at(s1);
    const dvec2 chord = part.b - part.a;
    const auto slope = [&](double s) {
        const dvec2 tangent = p.derivative(s);
        return cross(chord, tangent) / glm::dot(chord, tangent);
    };
    part.slopeA = slope(s0);
    part.slopeB = slope(s1);
    return part;
}

// ---- Pieces ---------------------------------------------------------------------------------------

std::uint32_t steps(double coordinate) {
    return std::uint32_t(std::lround(std::ldexp(coordinate + 1, patchStepLog2)));
}
double rounded(double coordinate) {
    return std::ldexp(std::nearbyint(std::ldexp(coordinate, patchStepLog2)), -int(patchStepLog2));
}
int slopeSteps(double slope) { return int(std::lround(glm::clamp(slope, -1.0, 1.0) * patchSlopeScale)); }

/// Pieces as the shader will know them: in patch coordinates, rounded.
class LocalPieces {
public:
    LocalPieces(const PatchPlace& place, double margin, std::span<const PlanarPiece* const> near)
        : side_(std::ldexp(double(latticeExtent), -place.level)),
          corner_(dvec2(place.x, place.y) * side_),
          margin_(margin) {
        for (const PlanarPiece* piece : near)
            add(*piece);
    }

    const std::vector<PlanarPiece>& pieces() const { return pieces_; }
    dvec2 toLattice(dvec2 local) const { return corner_ + local * side_; }

private:
    void add(const PlanarPiece& piece) {
        PlanarPiece local = piece;
        local.a = (piece.a - corner_) / side_;
        local.b = (piece.b - corner_) / side_;
        const double length = glm::length(local.b - local.a);
        const double parts =
            std::max(length <= longestPiece ? 1.0 : std::max(fewestParts, std::ceil(length / longestPart)),
                     std::ceil(length / longestBend(local, length)));
        if (parts == 1)
            return addRounded(local);
        for (double i = 0; i < parts; ++i)
            addRounded(partOf(local, i / parts, (i + 1) / parts));
    }

    /// A length over which the piece bends away from its tangents by no more than the shader may ignore.
    double longestBend(const PlanarPiece& piece, double length) const {
        const double turn = std::abs(piece.slopeA - piece.slopeB) + std::abs(piece.slopeA + piece.slopeB);
        const double pixel = margin_ * std::numbers::sqrt2, curvature = turn / length;
        const double most = flatEnough * pixel * 8 / curvature;
        // Within a box of one pixel nothing longer matters.
        return most >= pixel * pixel ? HUGE_VAL : std::sqrt(most);
    }

    void addRounded(PlanarPiece piece) {
        const double reach = margin_ + piece.bulge();
        const dvec2 least = glm::min(piece.a, piece.b) - reach, most = glm::max(piece.a, piece.b) + reach;
        if (!(least.x <= 1 && least.y <= 1 && most.x >= 0 && most.y >= 0))
            return;
        // Both pieces at a point round it alike, so that the map stays closed.
        piece.a = {rounded(piece.a.x), rounded(piece.a.y)};
        piece.b = {rounded(piece.b.x), rounded(piece.b.y)};
        piece.slopeA = slopeSteps(piece.slopeA) / patchSlopeScale;
        piece.slopeB = slopeSteps(piece.slopeB) / patchSlopeScale;
        if (piece.a != piece.b)
            pieces_.push_back(piece);
    }

    double side_;
    dvec2 corner_;
    double margin_;
    std::vector<PlanarPiece> pieces_;
};

/// Fields from the lowest bit of the first word on.
class Packer {
public:
    void add(std::uint32_t value, unsigned bits) {
        const std::uint64_t shifted = std::uint64_t(value & ((1u << bits) - 1)) << (used_ % 32);
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

Texel geometryTexel(const PlanarPiece& piece) {
    Packer packer;
    for (const double v : {piece.a.x, piece.a.y, piece.b.x, piece.b.y})
        packer.add(steps(v), patchCoordinateBits);
    for (const double slope : {piece.slopeA, piece.slopeB})
        packer.add(std::uint32_t(slopeSteps(slope)), 12);
    packer.add(piece.left, 16);
    packer.add(piece.right, 16);
    return packer.words();
}

/// Two words of a texel: 16-bit channels, nothing for programs.
void addColor(Packer& packer, const asset::Paint& paint) {
    for (const std::uint32_t channel : paint)
        packer.add(
            asset::isProgram(paint) ? 0 : std::uint32_t(std::lround(std::bit_cast<float>(channel) * 65535)),
            16);
}

Texel colorTexel(const asset::Paint& left, const asset::Paint& right) {
    Packer packer;
    addColor(packer, left);
    addColor(packer, right);
    return packer.words();
}

// ---- Lists ----------------------------------------------------------------------------------------

/// Pieces by cell: those of cell i are numbers[first[i]] to numbers[first[i + 1]], ascending.
struct Lists {
    std::vector<std::uint32_t> first, numbers;

    std::span<const std::uint32_t> of(std::size_t cell) const {
        return {numbers.data() + first[cell], numbers.data() + first[cell + 1]};
    }
};

/// Calls visit(cell) for every cell that the piece can come nearer to than `margin`.
template <class Visit>
void forEachCell(const PlanarPiece& p, double margin, Visit&& visit) {
    const dvec2 d = p.b - p.a;
    const double inverse = 1 / glm::dot(d, d);
    const double reach = margin + p.bulge();
    const double fromCentre = reach + cellSize * std::sqrt(0.5);
    const auto index = [&](double v) {
        return int(std::clamp(std::floor(v * cellCount), 0.0, cellCount - 1.0));
    };
    if (std::max(p.a.y, p.b.y) + reach < 0 || std::min(p.a.y, p.b.y) - reach > 1)
        return;
    const int firstRow = index(std::min(p.a.y, p.b.y) - reach),
              lastRow = index(std::max(p.a.y, p.b.y) + reach);
    for (int row = firstRow; row <= lastRow; ++row) {
        // The chord between the row's borders, moved outwards by the reach.
        double from = 0, to = 1;
        if (d.y != 0) {
            const double u = (row * cellSize - reach - p.a.y) / d.y,
                         v = ((row + 1) * cellSize + reach - p.a.y) / d.y;
            from = std::max(from, std::min(u, v));
            to = std::min(to, std::max(u, v));
            if (from > to)
                continue;
        }
        const double x0 = p.a.x + from * d.x, x1 = p.a.x + to * d.x;
        const double least = std::min(x0, x1) - reach, most = std::max(x0, x1) + reach;
        if (most < 0 || least > 1)
            continue;
        for (int column = index(least), last = index(most); column <= last; ++column)
            if (distance2(p.a, d, inverse, (dvec2(column, row) + 0.5) * cellSize) <= fromCentre * fromCentre)
                visit(std::uint32_t(row * cellCount + column));
    }
}

Lists listsOf(const std::vector<PlanarPiece>& pieces, double margin) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // cell, piece
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        forEachCell(pieces[i], margin, [&](std::uint32_t cell) { found.emplace_back(cell, i); });
    Lists lists;
    lists.first.assign(cellCount * cellCount + 1, 0);
    for (const auto& [cell, piece] : found)
        ++lists.first[cell + 1];
    for (std::size_t i = 1; i < lists.first.size(); ++i)
        lists.first[i] += lists.first[i - 1];
    std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
    lists.numbers.resize(found.size());
    for (const auto& [cell, piece] : found)
        lists.numbers[next[cell]++] = piece;
    return lists;
}

// ---- Reference points -----------------------------------------------------------------------------

struct Reference {
    dvec2 point;
    unsigned place = 0;
    std::uint32_t paint = 0;
};

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

Reference referenceIn(int column, int row, const std::vector<PlanarPiece>& pieces,
                      std::span<const std::uint32_t> list) {
    // From the middle outwards.
    static constexpr std::array<unsigned, 16> order{5, 10, 6, 9, 0, 15, 3, 12, 1, 14, 2, 13, 4, 11, 7, 8};
    Reference best;
    double bestClearance = -1;
    for (const unsigned place : order) {
        const dvec2 inCell = (dvec2(place % 4, place / 4) + 0.5) / 4.0;
        const dvec2 point = (dvec2(column, row) + inCell) * cellSize;
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

/// The net change of paint that a piece makes on the straight way from one point to another: 1 from right to
/// left, -1 from left to right.
int crossing(const PlanarPiece& p, dvec2 from, dvec2 to) {
    const Sides start = p.sidesOf(from), end = p.sidesOf(to);
    const dvec2 way = to - from;
    const bool between = (cross(way, p.a - from) > 0) != (cross(way, p.b - from) > 0);
    return (between ? int(end.leftOfChord) - int(start.leftOfChord) : 0) +
           (int(end.leftOfCurve) - int(end.leftOfChord)) - (int(start.leftOfCurve) - int(start.leftOfChord));
}

/// The paint at one point, known that at another; `a`, `b`: the pieces near either.
class Walk {
public:
    explicit Walk(const std::vector<PlanarPiece>& pieces) : pieces_(pieces) {}

    std::uint32_t paintAt(dvec2 to, const Reference& from, std::span<const std::uint32_t> a,
                          std::span<const std::uint32_t> b) {
        if (a.empty() && b.empty())
            return from.paint;
        changes_.clear();
        std::size_t i = 0, j = 0;
        while (i < a.size() || j < b.size()) {
            const std::uint32_t next = std::min(i < a.size() ? a[i] : ~0u, j < b.size() ? b[j] : ~0u);
            i += i < a.size() && a[i] == next;
            j += j < b.size() && b[j] == next;
            const PlanarPiece& piece = pieces_[next];
            if (const int change = crossing(piece, from.point, to); change > 0)
                changes_.push_back({0, piece.right, piece.left});
            else if (change < 0)
                changes_.push_back({0, piece.left, piece.right});
        }
        return paintBehind(from.paint, changes_);
    }

private:
    const std::vector<PlanarPiece>& pieces_;
    std::vector<Change> changes_;
};

// ---- Cells ----------------------------------------------------------------------------------------

/// Writes cells, and the references for which they have no room.
class CellWriter {
public:
    CellWriter(std::span<const asset::Paint> paints, const std::vector<PlanarPiece>& pieces,
               std::vector<Texel>& texels)
        : paints_(paints), pieces_(pieces), texels_(texels) {}

    Texel write(const Reference& reference, std::span<const std::uint32_t> list) {
        const bool wide = !list.empty() && list.back() >= narrowNumbers;
        const std::size_t room = wide ? 1 : 2;
        Packer packer;
        packer.add(reference.paint, 16);
        packer.add(reference.place, 16);
        addColor(packer, paints_[reference.paint]);
        Texel cell = packer.words();
        if (list.size() > room) {
            cell[0] |= moreBit;
            cell[3] = append(reference.point, list, wide);
            return cell;
        }
        cell[0] |= countBits(list.size(), wide);
        for (std::size_t i = 0; i < list.size(); ++i)
            cell[3] |= referenceWord(list[i], reference.point) << (i * 16);
        return cell;
    }

private:
    static constexpr std::uint32_t narrowNumbers = 1u << 14;

    static std::uint32_t countBits(std::size_t count, bool wide) {
        return std::uint32_t(count) << 20 | (wide ? wideBit : 0);
    }

    /// Returns the first texel.
    std::uint32_t append(dvec2 point, std::span<const std::uint32_t> list, bool wide) {
        const std::size_t all = wide ? 3 : 6, some = wide ? 2 : 4;
        const auto first = std::uint32_t(texels_.size());
        while (!list.empty()) {
            const bool more = list.size() > all;
            const std::size_t count = more ? some : list.size();
            Texel texel{countBits(count, wide) | (more ? moreBit : 0), 0, 0, 0};
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint32_t word = referenceWord(list[i], point);
                if (wide)
                    texel[1 + i] = word;
                else
                    texel[1 + i / 2] |= word << (i % 2 * 16);
            }
            if (more)
                texel[3] = std::uint32_t(texels_.size() + 1);
            texels_.push_back(texel);
            list = list.subspan(count);
        }
        return first;
    }

    std::uint32_t referenceWord(std::uint32_t number, dvec2 point) const {
        const Sides at = pieces_[number].sidesOf(point);
        return number << 2 | (at.leftOfCurve ? leftOfCurveBit : 0) | (at.leftOfChord ? leftOfChordBit : 0);
    }

    std::span<const asset::Paint> paints_;
    const std::vector<PlanarPiece>& pieces_;
    std::vector<Texel>& texels_;
};

/// y is moved to the middle between two lattice rows, as paintAt wants it.
dvec2 betweenRows(dvec2 lattice) { return {lattice.x, std::floor(lattice.y) + 0.5}; }

}  // namespace

Patch buildPatch(const PatchSource& source, const PatchPlace& place, double margin,
                 std::span<const PlanarPiece* const> near) {
    const LocalPieces local(place, margin, near);
    const std::vector<PlanarPiece>& pieces = local.pieces();
    const Lists lists = listsOf(pieces, margin);
    const auto paintIn = [&](dvec2 point) {
        return paintAt(source.asset, source.map, betweenRows(local.toLattice(point)), near);
    };
    Patch patch;
    if (lists.numbers.empty()) {
        patch.paint = paintIn(dvec2(0.5));
        return patch;
    }
    for (const PlanarPiece& piece : pieces) {
        patch.texels.push_back(geometryTexel(piece));
        patch.texels.push_back(colorTexel(source.asset.paints[piece.left], source.asset.paints[piece.right]));
    }
    std::vector<Texel> cells;
    cells.reserve(cellCount * cellCount);
    CellWriter writer(source.asset.paints, pieces, patch.texels);
    Walk walk(pieces);
    Reference rowStart, last;
    for (int row = 0; row < cellCount; ++row)
        for (int column = 0; column < cellCount; ++column) {
            const std::size_t i = cells.size();
            Reference here = referenceIn(column, row, pieces, lists.of(i));
            if (i == 0)
                here.paint = paintIn(here.point);
            else if (column == 0)
                here.paint = walk.paintAt(here.point, rowStart, lists.of(i - cellCount), lists.of(i));
            else
                here.paint = walk.paintAt(here.point, last, lists.of(i - 1), lists.of(i));
            cells.push_back(writer.write(here, lists.of(i)));
            last = here;
            if (column == 0)
                rowStart = here;
        }
    patch.firstCell = std::uint32_t(patch.texels.size());
    patch.texels.insert(patch.texels.end(), cells.begin(), cells.end());
    return patch;
}

}  // namespace vtm::gl

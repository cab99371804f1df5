/// \file
/// The integer lattice on which all topology is decided, and its exact predicates.
///
/// The root square of a map spans [-1, 2^b - 1] lattice steps in each axis, b <= 28. Vertices of the
/// scene have even coordinates; borders of cells have odd ones, at every level down to the last, so
/// no vertex ever lies on a border. Coordinates stay within ±2^29: differences fit 30 bits, their
/// products 60, and every predicate below is exact in 64 bits (crossings in 128).
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include <vtm/scene/affine.hpp>

namespace vtm::compiler {

using Coord = std::int32_t;

struct LatticePoint {
    Coord x = 0, y = 0;
    friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
    friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// Ordered as points are, in one comparison.
inline std::uint64_t sortKey(LatticePoint p) {
    const auto unsignedOrder = [](Coord v) { return static_cast<std::uint32_t>(v) ^ 0x8000'0000u; };
    return std::uint64_t{unsignedOrder(p.x)} << 32 | unsignedOrder(p.y);
}

inline constexpr int maxLatticeBits = 28;

/// Twice the signed area of (a, b, c): positive if c lies on the left of a→b.
inline std::int64_t orient(LatticePoint a, LatticePoint b, LatticePoint c) {
    return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
           (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

/// Whether a cell's corner lies on the left of the edge a→b; a corner exactly on the edge counts as
/// moved by +ε in x. The edge is never horizontal there, since corners are odd and vertices even.
inline bool cornerOnLeft(LatticePoint a, LatticePoint b, LatticePoint corner) {
    const std::int64_t o = orient(a, b, corner);
    return o != 0 ? o > 0 : b.y < a.y;
}

__extension__ typedef __int128 Int128;

/// Nearest even integer to numerator / denominator (denominator > 0), ties towards +infinity. It
/// never passes an odd integer on the way, so a point keeps its side of every border.
template <class Integer>
Coord roundToEven(Integer numerator, Integer denominator) {
    const Integer twice = 2 * denominator;
    const Integer shifted = numerator + denominator;
    const Integer quotient = shifted / twice;
    return static_cast<Coord>(2 * (quotient - (shifted % twice < 0)));
}

/// A square cell: borders at odd coordinates.
struct Square {
    Coord x0 = 0, y0 = 0;
    Coord side = 0;

    Coord x1() const { return x0 + side; }
    Coord y1() const { return y0 + side; }
    /// Corners counter-clockwise in the numbers, from (min, min).
    LatticePoint corner(int k) const { return {k == 1 || k == 2 ? x1() : x0, k >= 2 ? y1() : y0}; }
    /// Where side k lies, from corner k to the next: its y if k is even, its x if odd.
    Coord line(std::size_t k) const { return k == 0 ? y0 : k == 1 ? x1() : k == 2 ? y1() : x0; }
    Square child(int i, int j) const { return {x0 + i * (side / 4), y0 + j * (side / 4), side / 4}; }
};

/// How a picture lies on the lattice: its longer side takes 2^bits + 2 steps from -2, so that the
/// picture's own border lies just outside the root square and shapes that end there leave no slivers.
/// (The picture is stretched by 2^(1 - bits) for it: less than a step anywhere.)
class Lattice {
public:
    /// bits in [12, maxLatticeBits]
    Lattice(double width, double height, int bits);

    /// The map's root cell; it spans the square of the picture's longer side.
    Square square() const { return {-1, -1, Coord{1} << bits_}; }
    double stepsPerUnit() const { return scale_; }
    /// LoweredScene units to lattice steps, unrounded.
    scene::Affine toSteps() const { return {scale_, 0, 0, scale_, -2, -2}; }
    glm::dvec2 toUnits(LatticePoint p) const { return (glm::dvec2{p.x, p.y} + 2.0) / scale_; }
    /// The box, in steps, to which geometry is cut: beyond the root square where the picture reaches
    /// its border, exactly the picture's edge elsewhere.
    glm::dvec2 clampMin() const;
    glm::dvec2 clampMax() const { return clampMax_; }

private:
    int bits_;
    double scale_;
    glm::dvec2 clampMax_;
};

}  // namespace vtm::compiler

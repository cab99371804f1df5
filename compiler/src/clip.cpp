#include "compiler/src/clip.hpp"

namespace vtm::compiler {
namespace {

/// Where a→b meets the line x = at (or y = at, with the axes exchanged), rounded to an even position
/// strictly inside the side.
Coord cutPosition(Coord a, Coord b, Coord aAcross, Coord bAcross, Coord at, Coord low, Coord high) {
    const Int128 run = std::int64_t{bAcross} - aAcross;
    const Int128 rise = std::int64_t{b} - a;
    const Int128 numerator = a * run + rise * (std::int64_t{at} - aAcross);
    const Coord cut = run > 0 ? roundToEven(numerator, run) : roundToEven(-numerator, -run);
    return std::clamp(cut, low + 1, high - 1);
}

class Clipper {
public:
    explicit Clipper(const Square& square) : square_(square) {}

    std::optional<Chord> clip(const Chord& c) {
        for (int k = 0; k < 4; ++k)
            left_[static_cast<std::size_t>(k)] = cornerOnLeft(c.a, c.b, square_.corner(k));
        Chord part = c;
        bool entered = isInside(square_, c.a), left = isInside(square_, c.b);
        for (std::size_t side = 0; side < 4; ++side) {
            const std::size_t next = (side + 1) % 4;
            if (left_[side] == left_[next] || !spans(c, side))
                continue;
            // The sides run counter-clockwise: the first corner of the side by which an edge comes in
            // lies on its left, of the one by which it leaves on its right.
            const bool enters = left_[side];
            (enters ? part.a : part.b) = cut(c, side);
            (enters ? entered : left) = true;
        }
        if (!entered || !left || part.a == part.b)
            return std::nullopt;
        return part;
    }

private:
    static bool vertical(std::size_t side) { return side % 2 == 1; }
    Coord line(std::size_t side) const {
        return side == 0 ? square_.y0 : side == 1 ? square_.x1() : side == 2 ? square_.y1() : square_.x0;
    }
    bool spans(const Chord& c, std::size_t side) const {
        const Coord at = line(side);
        return vertical(side) ? (c.a.x < at) != (c.b.x < at) : (c.a.y < at) != (c.b.y < at);
    }
    LatticePoint cut(const Chord& c, std::size_t side) const {
        const Coord at = line(side);
        if (vertical(side))
            return {at, cutPosition(c.a.y, c.b.y, c.a.x, c.b.x, at, square_.y0, square_.y1())};
        return {cutPosition(c.a.x, c.b.x, c.a.y, c.b.y, at, square_.x0, square_.x1()), at};
    }

    const Square square_;
    std::array<bool, 4> left_{};
};

}  // namespace

std::optional<Chord> clip(const Square& square, const Chord& chord) { return Clipper(square).clip(chord); }

}  // namespace vtm::compiler

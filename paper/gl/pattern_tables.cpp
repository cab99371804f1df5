#include "paper/gl/pattern_tables.hpp"
#include "paper/gl/programs.hpp"

#include <cmath>
#include <map>
#include <utility>

#include <glm/vec2.hpp>

#include "backend_gl/core/gl.hpp"

namespace vtm::paper {

using namespace gl;

namespace {

using asset::Entry;
using glm::dvec2;

/// Texels of a cell, side by side; cells and nodes in a row of their textures.
constexpr std::size_t cellTexels = 4, cellsPerRow = 32, nodesPerRow = 16;

/// Levels below an entry.
unsigned depthOf(const Mask& mask, Entry entry) {
    unsigned depth = 0;
    if (entry.kind() == Entry::Kind::Node)
        for (const Entry child : mask.nodes[entry.payload()].children)
            depth = std::max(depth, 1 + depthOf(mask, child));
    return depth;
}

/// x: a multiple of 4.
PlaceTexel place(unsigned kind, std::size_t x, std::size_t y) {
    if (x > 0xFFFF || y > 0xFFFF)
        throw GlError("the mask has too many squares for a pattern");
    return kind | std::uint32_t(x) | std::uint32_t(y) << 16;
}

/// A square of the tree.
struct Square {
    Entry entry;
    dvec2 corner{0};  ///< periods
    double side = 1;

    Square child(const Mask& mask, std::size_t k) const {
        return {mask.nodes[entry.payload()].children[k], corner + side / 4 * dvec2(k % 4, k / 4), side / 4};
    }
};

/// Writes a square's cell, in periods, which single precision places as well as the point that is looked for;
/// what a place says of it.
PlaceTexel writeCell(const Mask& mask, const Square& square, Texels<CellTexel>& cells, std::size_t x,
                     std::size_t y) {
    const Cell& cell = mask.cells[square.entry.payload()];
    const auto inPeriods = [&](const std::array<std::uint16_t, 2>& p) {
        const dvec2 inSquare = dvec2(p[0], p[1]) / cellExtent * (1 + 2 * cellMargin);
        return square.corner + square.side * (inSquare - cellMargin);
    };
    const float combine = cell.combine == Operator::Intersection ? 1.0f : -1.0f;
    for (std::size_t i = 0; i < cell.count; ++i) {
        const Piece& piece = cell.pieces[i];
        const dvec2 a = inPeriods(piece.a), b = inPeriods(piece.b);
        cells.at(x + 2 * i, y) = {float(a.x), float(a.y), float(b.x), float(b.y)};
        cells.at(x + 2 * i + 1, y) = {float(piece.slopeA / slopeScale), float(piece.slopeB / slopeScale),
                                      combine, 0};
    }
    return place(unsigned(PatternKind::Inside) + cell.count, x, y);
}

class Tree {
public:
    Tree(const Mask& mask, unsigned depth) : mask_(mask), depth_(depth) {
        at({mask.root}, 0);  // the first node: at (0, 0)
    }
    PatternTables take() { return {std::move(places_), std::move(cells_)}; }

private:
    PlaceTexel at(const Square& square, unsigned level) {
        const Entry entry = square.entry;
        if (entry.kind() == Entry::Kind::Node) {
            const PlaceTexel made = newNode();
            for (std::size_t k = 0; k < 16; ++k) {
                const PlaceTexel below = at(square.child(mask_, k), level + 1);
                child(made, k) = below;
            }
            return made;
        }
        if (entry.kind() == Entry::Kind::Leaf)
            return alike([&] { return newCell(square); }, level);
        const std::pair key(level, entry.payload());
        const auto found = shared_.find(key);
        return found != shared_.end()
                   ? found->second
                   : shared_[key] = alike([&] { return place(entry.payload(), 0, 0); }, level);
    }

    /// Nodes from `level` down to the finest squares, which are all `finest`; made last, so that the root is
    /// first.
    template <class Make>
    PlaceTexel alike(Make&& finest, unsigned level) {
        if (level == depth_)
            return finest();
        const PlaceTexel made = newNode(), below = alike(finest, level + 1);
        for (std::size_t k = 0; k < 16; ++k)
            child(made, k) = below;
        return made;
    }

    PlaceTexel newNode() {
        const std::size_t x = nodeCount_ % nodesPerRow * 4, y = nodeCount_ / nodesPerRow * 4;
        ++nodeCount_;
        places_.growTo(y + 4);
        return place(0, x, y);
    }

    PlaceTexel& child(PlaceTexel node, std::size_t k) {
        return places_.at((node & 0xFFFF) + k % 4, (node >> 16) + k / 4);
    }

    PlaceTexel newCell(const Square& square) {
        const std::size_t x = cellCount_ % cellsPerRow * cellTexels, y = cellCount_ / cellsPerRow;
        ++cellCount_;
        cells_.growTo(y + 1);
        return writeCell(mask_, square, cells_, x, y);
    }

    const Mask& mask_;
    unsigned depth_;
    Texels<PlaceTexel> places_{4 * nodesPerRow, 4};
    Texels<CellTexel> cells_{cellTexels * cellsPerRow, 1};
    std::size_t nodeCount_ = 0, cellCount_ = 0;
    std::map<std::pair<unsigned, std::uint32_t>, PlaceTexel> shared_;
};

}  // namespace

unsigned patternDepth(const Mask& mask) { return depthOf(mask, mask.root); }

PatternTables treeTables(const Mask& mask, unsigned depth) { return Tree(mask, depth).take(); }

PatternTables gridTables(const Mask& mask, unsigned depth) {
    const std::size_t side = std::size_t(1) << (2 * depth);
    if (int(cellTexels * side) > limit(GL_MAX_TEXTURE_SIZE))
        throw GlError("the mask has too many finest squares for a grid");
    PatternTables t{{side, side}, {cellTexels * side, side}};
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            Square square{mask.root};
            for (unsigned level = depth; square.entry.kind() == Entry::Kind::Node;) {
                --level;
                square = square.child(mask, (y >> (2 * level) & 3) * 4 + (x >> (2 * level) & 3));
            }
            t.places.at(x, y) = square.entry.kind() == Entry::Kind::Solid
                                    ? place(square.entry.payload(), 0, 0)
                                    : writeCell(mask, square, t.cells, cellTexels * x, y);
        }
    return t;
}

}  // namespace vtm::paper

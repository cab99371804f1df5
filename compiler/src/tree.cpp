#include "compiler/src/tree.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <set>

#include "compiler/compile.hpp"
#include "compiler/src/fit.hpp"
#include "compiler/src/planar.hpp"
#include "compiler/src/winding.hpp"

namespace vtm::compiler {
namespace {

using asset::Entry;

/// A leaf with more chords is not tried while it may be split: planarising is quadratic.
constexpr std::size_t maxChordsToTry = 400;
/// A cell of the last level with more is filled with the mean of samples.
constexpr std::size_t maxChordsInLastLeaf = 2000;
/// Pairs of chords looked at in leaves before the picture is refused: a minute or so.
constexpr std::size_t maxWork = 20'000'000'000;
/// What passing one chord down a level, or classifying one point by it, counts in pairs. Without it
/// thousands of equal outlines, which go down to the last level, are pushed and sampled for minutes.
constexpr std::size_t visitWork = 100;

struct LayerWinding {
    std::uint32_t layer;
    int winding;
};

/// What is left of the picture in one cell.
struct Content {
    Square square;
    unsigned level = 0;
    std::vector<std::uint32_t> chords;   ///< those that pass through, ascending, so by layer
    std::vector<LayerWinding> windings;  ///< at the first corner, ascending by layer, zero left out
};

class Stopwatch {
public:
    explicit Stopwatch(double& into) : into_(into), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() {
        into_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    double& into_;
    const std::chrono::steady_clock::time_point start_;
};

class TreeBuilder {
public:
    TreeBuilder(const Picture& picture, Painter& painter, const TreeOptions& options, asset::Asset& asset,
                TreeTimes& times)
        : picture_(picture),
          painter_(painter),
          options_(options),
          asset_(asset),
          times_(times),
          covers_(picture.layers.size(), Cover::Out),
          inside_(picture.layers.size()) {}

    Entry run(const Square& square, std::span<const std::uint32_t> layers) {
        firstLayer_ = layers.empty() ? 0 : layers.front();
        return build(root(square, layers));
    }

private:
    // ---- push ---------------------------------------------------------------------------------

    std::uint32_t layerOf(std::uint32_t chord) const {
        const auto after =
            std::upper_bound(picture_.layers.begin() + firstLayer_, picture_.layers.end(), chord,
                             [](std::uint32_t c, const Layer& l) { return c < l.firstChord; });
        return static_cast<std::uint32_t>(after - picture_.layers.begin() - 1);
    }

    /// Calls visit(layer, chords of that layer) for each run of a layer's chords.
    template <class Visit>
    void forEachLayer(std::span<const std::uint32_t> chords, Visit&& visit) const {
        for (std::size_t i = 0; i < chords.size();) {
            const std::uint32_t layer = layerOf(chords[i]);
            const std::uint32_t end = picture_.layers[layer].firstChord + picture_.layers[layer].chordCount;
            std::size_t j = i + 1;
            while (j < chords.size() && chords[j] < end)
                ++j;
            visit(layer, chords.subspan(i, j - i));
            i = j;
        }
    }

    Content root(const Square& square, std::span<const std::uint32_t> layers) const {
        Content content{square, 0, {}, {}};
        for (std::uint32_t index : layers) {
            const Layer& layer = picture_.layers[index];
            int winding = 0;
            for (std::uint32_t c = layer.firstChord; c < layer.firstChord + layer.chordCount; ++c) {
                const Chord& chord = picture_.chords[c];
                // From a point left of everything, where the winding is zero.
                winding += windingAlongX(chord, square.y0, square.x0 - outside, square.x0);
                if (meets(chord, square))
                    content.chords.push_back(c);
            }
            if (winding != 0)
                content.windings.push_back({index, winding});
        }
        return content;
    }

    /// Chords and windings of the 16 children.
    std::array<Content, 16> split(const Content& cell) const {
        std::array<Content, 16> children;
        for (int i = 0; i < 16; ++i)
            children[static_cast<std::size_t>(i)] = {cell.square.child(i % 4, i / 4), cell.level + 1, {}, {}};
        auto known = cell.windings.begin();
        const auto copyKnown = [&](std::uint32_t below) {
            for (; known != cell.windings.end() && known->layer < below; ++known)
                for (Content& child : children)
                    child.windings.push_back(*known);
        };
        forEachLayer(cell.chords, [&](std::uint32_t layer, std::span<const std::uint32_t> chords) {
            copyKnown(layer);
            int base = 0;
            if (known != cell.windings.end() && known->layer == layer)
                base = (known++)->winding;
            std::array<int, 16> windings;
            windings.fill(base);
            for (std::uint32_t c : chords)
                push(c, cell.square, children, windings);
            for (std::size_t i = 0; i < 16; ++i)
                if (windings[i] != 0)
                    children[i].windings.push_back({layer, windings[i]});
        });
        copyKnown(none);
        return children;
    }

    void push(std::uint32_t index, const Square& square, std::array<Content, 16>& children,
              std::array<int, 16>& windings) const {
        const Chord& c = picture_.chords[index];
        const Coord step = square.side / 4;
        const auto place = [&](Coord v, Coord origin) {
            return static_cast<int>(std::clamp<std::int64_t>((std::int64_t{v} - origin) / step, 0, 3));
        };
        const int i0 = place(std::min(c.a.x, c.b.x), square.x0),
                  i1 = place(std::max(c.a.x, c.b.x), square.x0);
        const int j0 = place(std::min(c.a.y, c.b.y), square.y0),
                  j1 = place(std::max(c.a.y, c.b.y), square.y0);
        for (int j = j0; j <= j1; ++j)
            for (int i = i0; i <= i1; ++i) {
                Content& child = children[static_cast<std::size_t>(4 * j + i)];
                if (meets(c, child.square))
                    child.chords.push_back(index);
            }
        // Along the first column up to row j, then along row j.
        for (int j = 0; j < 4; ++j) {
            const Coord y = square.y0 + j * step;
            const int up = j > 0 ? windingAlongY(c, square.x0, square.y0, y) : 0;
            for (int i = 0; i < 4; ++i)
                windings[static_cast<std::size_t>(4 * j + i)] +=
                    up + (i > 0 ? windingAlongX(c, y, square.x0, square.x0 + i * step) : 0);
        }
    }

    // ---- layers -------------------------------------------------------------------------------

    bool isInside(std::uint32_t layer, int winding) const {
        return picture_.layers[layer].rule == scene::FillRule::NonZero ? winding != 0 : winding % 2 != 0;
    }

    std::vector<std::uint32_t> layersOf(const Content& cell) const {
        std::vector<std::uint32_t> layers;
        forEachLayer(cell.chords, [&](std::uint32_t layer, auto) { layers.push_back(layer); });
        const std::size_t edges = layers.size();
        for (const LayerWinding& w : cell.windings)
            layers.push_back(w.layer);
        std::inplace_merge(layers.begin(), layers.begin() + static_cast<std::ptrdiff_t>(edges), layers.end());
        layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
        return layers;
    }

    /// Drops the layers that cannot show in the cell.
    void cull(Content& cell) {
        const std::vector<std::uint32_t> layers = layersOf(cell);
        for (const LayerWinding& w : cell.windings)
            covers_[w.layer] = isInside(w.layer, w.winding) ? Cover::In : Cover::Out;
        forEachLayer(cell.chords, [&](std::uint32_t layer, auto) { covers_[layer] = Cover::Edge; });
        std::vector<std::uint8_t> keep(layers.size(), true);
        painter_.cull(layers, covers_, keep);
        for (std::uint32_t layer : layers)
            covers_[layer] = Cover::Out;
        if (std::find(keep.begin(), keep.end(), false) == keep.end())
            return;
        const auto kept = [&](std::uint32_t layer) {
            return keep[static_cast<std::size_t>(std::lower_bound(layers.begin(), layers.end(), layer) -
                                                 layers.begin())] != 0;
        };
        std::vector<std::uint32_t> chords;
        forEachLayer(cell.chords, [&](std::uint32_t layer, std::span<const std::uint32_t> run) {
            if (kept(layer))
                chords.insert(chords.end(), run.begin(), run.end());
        });
        cell.chords = std::move(chords);
        std::erase_if(cell.windings, [&](const LayerWinding& w) { return !kept(w.layer); });
    }

    std::uint16_t paint(std::span<const std::uint32_t> layers, std::span<const int> windings) {
        for (std::size_t i = 0; i < layers.size(); ++i)
            inside_[layers[i]] = isInside(layers[i], windings[i]);
        const std::uint16_t result = painter_.paint(layers, inside_);
        for (std::uint32_t layer : layers)
            inside_[layer] = false;
        return result;
    }

    /// Windings at the first corner, one for each of `layers`.
    static std::vector<int> cornerWindings(const Content& cell, std::span<const std::uint32_t> layers) {
        std::vector<int> windings(layers.size());
        for (const LayerWinding& w : cell.windings)
            windings[static_cast<std::size_t>(std::lower_bound(layers.begin(), layers.end(), w.layer) -
                                              layers.begin())] = w.winding;
        return windings;
    }

    // ---- build --------------------------------------------------------------------------------

    Entry build(Content cell) {
        spend(cell.chords.size() * visitWork);
        {
            const Stopwatch watch(times_.push);
            cull(cell);
        }
        const std::vector<std::uint32_t> layers = layersOf(cell);
        const std::vector<int> windings = cornerWindings(cell, layers);
        if (cell.chords.empty())
            return Entry::make(Entry::Kind::Solid, paint(layers, windings));
        const bool last = cell.level >= options_.maxDepth;
        const std::size_t most = last ? maxChordsInLastLeaf : maxChordsToTry;
        const std::size_t distinct =
            last || cell.level >= options_.minDepth ? distinctChords(cell, most) : most + 1;
        if (last && distinct > most)
            return emitMean(cell, layers, windings);
        if (distinct <= most) {
            spend(distinct * distinct);
            const auto leaf = makeLeaf(cell, layers, windings);
            if (leaf && (last || leaf->pieces.size() <= options_.piecesPerLeaf))
                return emit(*leaf);
            if (last)
                return emitMean(cell, layers, windings);
        }
        return buildNode(cell);
    }

    /// Equal chords of many layers (a shape repeated) count once: snapping merges them at once. Stops
    /// counting beyond `most`.
    std::size_t distinctChords(const Content& cell, std::size_t most) const {
        if (cell.chords.size() <= most)
            return cell.chords.size();
        std::set<std::pair<LatticePoint, LatticePoint>> ends;
        for (std::uint32_t c : cell.chords) {
            ends.insert(std::minmax(picture_.chords[c].a, picture_.chords[c].b));
            if (ends.size() > most)
                break;
        }
        return ends.size();
    }

    void spend(std::size_t work) {
        work_ += work;
        if (work_ > maxWork)
            throw LimitError("the picture's outlines are too tangled: beyond " + std::to_string(maxWork) +
                             " pairs of chords");
    }

    Entry buildNode(Content& cell) {
        std::array<Content, 16> children;
        {
            const Stopwatch watch(times_.push);
            children = split(cell);
        }
        cell = {};
        const std::size_t index = asset_.nodes.size();  // before its children's: walks need no cycle check
        asset_.nodes.emplace_back();
        asset::Node node;
        for (std::size_t i = 0; i < 16; ++i)
            node.children[i] = build(std::move(children[i]));
        const Entry first = node.children[0];
        const bool same =
            first.kind() == Entry::Kind::Solid && std::all_of(node.children.begin(), node.children.end(),
                                                              [&](Entry e) { return e.bits == first.bits; });
        if (same) {
            asset_.nodes.pop_back();  // solid children made no nodes
            return first;
        }
        asset_.nodes[index] = node;
        return Entry::make(Entry::Kind::Node, static_cast<std::uint32_t>(index));
    }

    std::optional<FittedLeaf> makeLeaf(const Content& cell, std::span<const std::uint32_t> layers,
                                       std::span<const int> windings) {
        PlanarLeaf planar;
        {
            const Stopwatch watch(times_.planarise);
            std::vector<LeafChord> chords;
            std::uint32_t local = 0;
            forEachLayer(cell.chords, [&](std::uint32_t layer, std::span<const std::uint32_t> run) {
                while (layers[local] != layer)
                    ++local;
                for (std::uint32_t c : run)
                    chords.push_back({picture_.chords[c], local});
            });
            planar = planarise(cell.square, chords, windings,
                               [&](std::span<const int> w) { return paint(layers, w); });
        }
        if (!planar.certified)
            return std::nullopt;
        const Stopwatch watch(times_.fit);
        FittedLeaf fitted = fit(cell.square, planar, options_.fitTolerance);
        return fitted.pieces.size() <= maxLeafPieces ? std::optional(std::move(fitted)) : std::nullopt;
    }

    Entry emit(const FittedLeaf& fitted) {
        if (fitted.pieces.empty())
            return Entry::make(Entry::Kind::Solid, fitted.corners[0]);
        asset::Leaf leaf;
        leaf.firstPiece = static_cast<std::uint32_t>(asset_.pieces.size());
        leaf.pieceCount = static_cast<std::uint16_t>(fitted.pieces.size());
        leaf.corners = fitted.corners;
        asset_.pieces.insert(asset_.pieces.end(), fitted.pieces.begin(), fitted.pieces.end());
        asset_.leaves.push_back(leaf);
        return Entry::make(Entry::Kind::Leaf, static_cast<std::uint32_t>(asset_.leaves.size() - 1));
    }

    /// The fallback: the mean over 4 × 4 points, each classified by winding (after Ganacim et al. 2014).
    Entry emitMean(const Content& cell, std::span<const std::uint32_t> layers, std::span<const int> corner) {
        ++asset_.fallbackLeaves;
        spend(16 * cell.chords.size() * visitWork);
        std::vector<std::uint16_t> paints;
        const Coord step = cell.square.side / 8;
        for (int i = 0; i < 16; ++i) {
            const LatticePoint p{(cell.square.x0 + (2 * (i % 4) + 1) * step) | 1,
                                 (cell.square.y0 + (2 * (i / 4) + 1) * step) | 1};
            std::vector<int> windings(corner.begin(), corner.end());
            std::size_t local = 0;
            forEachLayer(cell.chords, [&](std::uint32_t layer, std::span<const std::uint32_t> run) {
                while (layers[local] != layer)
                    ++local;
                for (std::uint32_t c : run)
                    windings[local] += windingBetween(picture_.chords[c], cell.square.corner(0), p);
            });
            paints.push_back(paint(layers, windings));
        }
        return Entry::make(Entry::Kind::Solid, painter_.mean(paints));
    }

    /// Further left than any geometry reaches.
    static constexpr Coord outside = 1 << 20;
    /// Leaf::pieceCount is 16 bits.
    static constexpr std::size_t maxLeafPieces = 0xFFFF;

    const Picture& picture_;
    Painter& painter_;
    const TreeOptions& options_;
    asset::Asset& asset_;
    TreeTimes& times_;
    std::uint32_t firstLayer_ = 0;
    std::size_t work_ = 0;
    std::vector<Cover> covers_;
    std::vector<std::uint8_t> inside_;
};

}  // namespace

asset::Entry buildTree(const Picture& picture, const Square& root, std::span<const std::uint32_t> layers,
                       Painter& painter, const TreeOptions& options, asset::Asset& asset, TreeTimes& times) {
    return TreeBuilder(picture, painter, options, asset, times).run(root, layers);
}

}  // namespace vtm::compiler

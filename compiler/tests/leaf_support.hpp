/// \file
/// Leaves made of polygons, for the tests of the planar map and of fitting.
#pragma once

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "compiler/fit/fit.hpp"
#include "compiler/planar/planar.hpp"
#include "compiler/tree/cell.hpp"

namespace vtm::compiler {

using Polygon = std::vector<LatticePoint>;

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    Coord even(Coord low, Coord high) {
        return 2 * std::uniform_int_distribution<Coord>(low / 2, high / 2)(engine_);
    }

private:
    std::mt19937 engine_;
};

/// Coordinates of test geometry stay within this.
inline constexpr double everywhere = 1 << 27;

inline scene::Path pathOf(const Polygon& polygon) {
    scene::Path path;
    for (const LatticePoint p : polygon)
        path.push_back(path.empty() ? scene::Command{scene::MoveTo{{p.x, p.y}}}
                                    : scene::Command{scene::LineTo{{p.x, p.y}}});
    path.push_back(scene::Close{});
    return path;
}

/// A square with closed outlines over and around it, one a layer.
struct TestLeaf {
    Square square;
    LoweredScene picture;
    Cell cell;
    std::vector<int> corner;  ///< windings at its first corner

    TestLeaf(const Square& s, const std::vector<scene::Path>& paths, double tolerance = 0.5) : square(s) {
        std::vector<std::uint32_t> layers;
        for (const scene::Path& path : paths) {
            const auto first = static_cast<std::uint32_t>(picture.outlines.runs.size());
            addOutline(picture.outlines, path, scene::identity, tolerance, {-everywhere, -everywhere},
                       {everywhere, everywhere});
            layers.push_back(static_cast<std::uint32_t>(layers.size()));
            picture.layers.push_back({scene::FillRule::NonZero, first,
                                      static_cast<std::uint32_t>(picture.outlines.runs.size()) - first});
        }
        cell = rootCell(picture, square, layers);
        corner.resize(layers.size());
        for (const LayerWinding& w : cell.windings)
            corner[w.layer] = w.winding;
    }
    Points points() const { return picture.outlines.points; }

    /// Calls visit(chord, layer) for every chord, in the square or not.
    template <class Visit>
    void forEachChord(Visit&& visit) const {
        for (std::uint32_t l = 0; l < picture.layers.size(); ++l)
            for (std::uint32_t r = 0; r < picture.layers[l].runCount; ++r) {
                const Run run = picture.outlines.runs[picture.layers[l].firstRun + r];
                for (std::uint32_t i = run.first; i < run.last; ++i)
                    visit(picture.outlines.chord(i), l);
            }
    }
};

inline TestLeaf leafOf(const Square& square, const std::vector<Polygon>& polygons) {
    std::vector<scene::Path> paths;
    for (const Polygon& p : polygons)
        paths.push_back(pathOf(p));
    return {square, paths};
}

/// Each combination of inside and outside is a paint of its own.
class BitPaints : public RegionPaints {
public:
    explicit BitPaints(std::span<const int> corner) : layers_(static_cast<std::uint32_t>(corner.size())) {
        std::vector<Layer> layers;
        for (int winding : corner)
            layers.push_back({scene::FillRule::NonZero, winding, hashValue(layers.size())});
        enter(layers);
    }

private:
    PaintId compute() override {
        PaintId bits = 0;
        for (std::uint32_t i = 0; i < layers_; ++i)
            bits |= PaintId{isInside(i)} << i;
        return bits;
    }
    const std::uint32_t layers_;
};

/// Plans a leaf and remembers what the result refers to.
struct Planned {
    BitPaints bits;
    Planariser planariser;
    const PlanarLeaf& leaf;

    explicit Planned(const TestLeaf& t)
        : bits(t.corner), leaf(planariser.run(t.square, t.points(), t.cell.clippedRuns, bits)) {}
};

}  // namespace vtm::compiler

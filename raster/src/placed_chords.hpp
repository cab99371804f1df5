/// \file
/// Chords of a map that is placed many times, such as a letter's: made once for all places of it that differ
/// by a translation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/instances.hpp"
#include "raster/chord.hpp"
#include "raster/src/boundary_chords.hpp"
#include "raster/src/scanned_map.hpp"

namespace vtm::asset {

/// Chords around the point (0, 0), of the paints that the map names; all of them, wherever a view ends.
struct PlacedChords {
    glm::dmat2 linear{0};  ///< from the map's square, [0, 1]², to pixels
    std::vector<Chord> chords;
    glm::vec2 min{0}, max{0};

    void make(const ScannedMap& map, const glm::dmat2& toPixels) {
        linear = toPixels;
        chords.clear();
        min = max = glm::vec2(0);
        const Affine2 toLattice{toPixels * (1 / map.place().extent), glm::dvec2(0)};
        Chords made(toLattice, {0, 0},
                    [&](std::span<const glm::vec2> points, std::uint32_t left, std::uint32_t right) {
                        for (std::size_t i = 1; i < points.size(); ++i)
                            add({points[i - 1], points[i], left, right});
                    });
        for (std::size_t i = 0; i < map.boxCount(); ++i) {
            limits::check();
            made.addAnywhere(map.box(i).at(made.pixel()));
        }
    }

private:
    void add(const Chord& chord) {
        if (chord.a.y == chord.b.y)  // it changes no row
            return;
        chords.push_back(chord);
        min = glm::min(min, glm::min(chord.a, chord.b));
        max = glm::max(max, glm::max(chord.a, chord.b));
    }
};

/// Those of each placed map under the matrix with which it was placed last.
class PlacedChordsByMap {
public:
    const PlacedChords& of(std::size_t number, const ScannedMap& map, const glm::dmat2& toPixels) {
        if (number >= byMap_.size())
            byMap_.resize(number + 1);
        PlacedChords& known = byMap_[number];
        if (known.linear != toPixels)
            known.make(map, toPixels);
        return known;
    }

private:
    std::vector<PlacedChords> byMap_;
};

}  // namespace vtm::asset

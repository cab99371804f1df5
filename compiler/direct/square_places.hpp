/// \file
/// Places in a square, at each of which it is asked what covers it: 16 rows of 16.
///
/// Place (r, c) lies at x = c/16 + t(r), y = r/16 + t(c), where t gives each of the numbers (k + 1/2)/256, k
/// < 16. No two places are above each other, and none beside each other. So the share of the square on one
/// side of an edge is known to 1/256 where the edge is level or upright, and to 1.2/256 (root mean square)
/// where it is not.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace vtm::compiler {

inline constexpr int placesAlong = 16, placesInSquare = placesAlong * placesAlong;

/// Winding numbers of a layer at the places, modulo 2^16.
using PlaceWindings = std::array<std::int16_t, placesInSquare>;
/// What is left of the light there, in parts of `fullLight`.
using PlaceLights = std::array<std::uint16_t, placesInSquare>;
inline constexpr std::uint16_t fullLight = 0x7FFF;

/// Heights in a row of squares, which lies between 0 and 1.
class PlaceRange {
public:
    PlaceRange(float top, float bottom);
    /// Adds to the winding numbers between the heights.
    void add(PlaceWindings& windings, std::int32_t winding) const;

private:
    friend class PlacedEdge;
    template <class Visit>
    void forEachRow(const Visit& visit) const;

    std::int16_t top_, bottom_;
};

/// How much of all light was taken, and what is left there.
struct TakenLight {
    float taken;
    std::uint16_t most;  ///< at a place, or more
};

/// The line of an edge that goes down, in squares: the row is between 0 and 1. Equal lines divide the places
/// alike.
class PlacedEdge {
public:
    /// Through a point; dx / dy.
    PlacedEdge(glm::vec2 a, float slope);
    /// Adds to the winding numbers on its right, at all heights of a square of the row.
    void add(PlaceWindings& windings, int square, std::int32_t winding) const;
    /// And at some.
    void add(PlaceWindings& windings, int square, std::int32_t winding, const PlaceRange& range) const;

private:
    friend TakenLight takeLightBeside(PlaceLights& lights, const PlacedEdge& edge, int square, bool isLeft,
                                      float alpha);

    std::array<std::int16_t, placesAlong> columnsIn(int square) const;

    // On its right, perX_ x + perY_ y > perX_ a.x + perY_ a.y.
    glm::vec2 a_;
    float perX_, perY_;
    std::array<std::int16_t, placesAlong> columns_, rows_;
};

/// Winding numbers of a row of squares for a layer of very many edges: what they change by from each place to
/// the next. Of a row of places that an edge crosses it is asked in the middle which lie on its right; of a
/// column that a nearly level one crosses, which lie above it.
class PlaceSteps {
public:
    explicit PlaceSteps(int squares);
    int squares() const { return squares_; }

    /// Rows from `first` on, before `end`, lie beside an edge that is at x in the middle of the first, in
    /// squares, and goes on by `perRow`.
    void add(int first, int end, float x, float perRow, std::int32_t winding);
    /// They lie beside a nearly level edge, from a down to b; above and below it, beside its ends.
    void addLevel(int first, int end, glm::vec2 a, glm::vec2 b, std::int32_t winding);
    /// Gives the winding numbers of all squares, one after another, to take(square, windings), and forgets
    /// the steps.
    template <class Take>
    void takeAll(const Take& take);

private:
    using Column = std::array<std::int16_t, placesAlong>;
    /// By row and column of a square, and what is below it.
    using LevelSteps = std::array<Column, placesAlong + 1>;

    void startFrom(int column, int row, std::int32_t winding);
    /// `before`: the winding numbers on the left of the square, by row.
    void windingsOf(int square, Column& before, PlaceWindings& windings) const;

    int squares_;
    float last_;
    std::size_t rowSize_;
    std::vector<std::int16_t> steps_;  ///< by row and place; the last place of each is beyond the row
    // Of nearly level edges, by square: from a place down, in its column, and in all columns from there on.
    bool hasLevel_ = false;
    std::vector<LevelSteps> inColumn_, fromColumn_;
};

template <class Take>
void PlaceSteps::takeAll(const Take& take) {
    Column before{};
    PlaceWindings windings;
    for (int square = 0; square < squares_; ++square) {
        windingsOf(square, before, windings);
        take(square, windings);
    }
    std::ranges::fill(steps_, std::int16_t(0));
    if (hasLevel_) {
        std::ranges::fill(inColumn_, LevelSteps{});
        std::ranges::fill(fromColumn_, LevelSteps{});
    }
    hasLevel_ = false;
}

/// Takes a layer's part, `alpha`, of the light where the winding number is not zero, or is odd.
TakenLight takeLight(PlaceLights& lights, const PlaceWindings& windings, bool isEvenOdd, float alpha);
/// The same on one side of an edge, at all heights of a square of the row.
TakenLight takeLightBeside(PlaceLights& lights, const PlacedEdge& edge, int square, bool isLeft, float alpha);
/// Lights become (1 - share) of themselves and `times` others. Returns how much of all light is left.
float mixLights(PlaceLights& lights, float share, const PlaceLights& others, float times);

}  // namespace vtm::compiler

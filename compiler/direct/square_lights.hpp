/// \file
/// What light is left in a row of squares under the layers that have been laid there, and what colours they
/// have.
///
/// Layers are taken from the top. Each takes its part of the light that is left at the places inside of it. A
/// square in which no light is left is closed, and costs nothing from then on.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>

#include "compiler/direct/solid_layers.hpp"
#include "compiler/direct/square_places.hpp"

namespace vtm::compiler {

/// A line through a row of squares: where it enters and leaves it, in squares.
struct RowLine {
    float enter, leave;

    float at(float y) const { return enter + y * (leave - enter); }
    RowLine movedBy(float x) const { return {enter + x, leave + x}; }
};

/// For one thread.
class SquareLights {
public:
    explicit SquareLights(std::vector<SolidLayers::Group> groups) : groups_(std::move(groups)) {}

    /// A row of so many, all of which are open.
    void begin(std::int32_t squares);
    std::int32_t squares() const { return count_; }
    bool areClosed() const { return open_ == 0; }
    /// The first that is open, from that one on; squares() if there is none.
    std::int32_t nextOpen(std::int32_t square);

    /// What is laid from now on is in that group. Groups come one after another, each within those round it.
    void enter(std::uint32_t group);
    /// Lays a layer into all of a square.
    void cover(std::int32_t square, const SolidLayers::Layer& layer);
    /// Into the places where its winding number says so. Returns whether they are dark then.
    bool cover(std::int32_t square, const SolidLayers::Layer& layer, const PlaceWindings& windings);
    /// On one side of an edge that spans the row.
    bool coverBeside(std::int32_t square, const SolidLayers::Layer& layer, const PlacedEdge& edge,
                     bool isLeft);

    /// All places left of the one, or right of the other, are known to be dark.
    RowLine darkLeft(std::int32_t square) const { return known(square).darkLeft; }
    RowLine darkRight(std::int32_t square) const { return known(square).darkRight; }
    void keepDarkLeft(std::int32_t square, const RowLine& line);
    void keepDarkRight(std::int32_t square, const RowLine& line);

    /// Leaves all groups. By square, premultiplied.
    std::span<const glm::vec4> finish();

private:
    static constexpr float nowhere = 1e9f;

    struct Square {
        float light = 1;  ///< what comes through layers that cover all of it
        float mean = 1;   ///< and through the others, in the mean
        bool hasPlaces = false;
        std::uint32_t entry = 0;  ///< of its level, when it was touched
        std::int32_t next = 0;    ///< a square further right, up to which all are closed; or itself
        RowLine darkLeft{-nowhere, -nowhere}, darkRight{nowhere, nowhere};

        float left() const { return light * mean; }
    };
    /// A group that is composited, in the squares that it touches; the first is the picture.
    struct Level {
        std::uint32_t group = noIndex;
        float weight = 1;         ///< of its colours in the picture
        std::uint32_t entry = 0;  ///< tells from other groups that were at this depth
        std::vector<Square> squares;
        std::vector<PlaceLights> lights;  ///< through the others; of those that have places
        std::vector<std::int32_t> touched;
    };

    /// In the group that was entered last, or as far as it was touched.
    const Square& known(std::int32_t square) const;
    Square& touch(std::int32_t square) { return touch(depth_ - 1, square); }
    Square& touch(std::size_t level, std::int32_t square);
    PlaceLights& placesOf(std::size_t level, std::int32_t square);
    bool take(std::int32_t square, const SolidLayers::Layer& layer, const TakenLight& light);
    void closeIfDark(std::int32_t square);
    void leaveGroup();

    std::vector<SolidLayers::Group> groups_;
    std::vector<Level> levels_{1};
    std::size_t depth_ = 1;  ///< levels that are entered
    std::uint32_t entries_ = 0;
    std::int32_t count_ = 0, open_ = 0;
    std::vector<glm::vec4> colors_;
};

}  // namespace vtm::compiler

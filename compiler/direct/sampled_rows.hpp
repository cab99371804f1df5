/// \file
/// Rows of colours in which too much begins, ends or crosses to be followed: what shows is asked for at
/// places.
///
/// A row of pixels is cut into squares, each of which has its places. Layers are taken from the top. A square
/// that no chain of a layer touches is inside it or outside, and so are all of its places; where chains pass,
/// winding numbers tell. What the layer takes of the light there is its share of the picture. So the work is
/// that of the squares that chains touch and in which they show. What crosses there does not matter.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "compiler/containers/sort_places.hpp"
#include "compiler/direct/cut_chains.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/direct/solid_layers.hpp"
#include "compiler/direct/square_lights.hpp"
#include "compiler/direct/square_places.hpp"
#include "compiler/direct/view_chains.hpp"
#include "compiler/lower/lowered_scene.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {

/// For one thread.
class SampledRows {
public:
    /// Of a picture that has colours only, unclipped. `state` numbers the pixels' colours. All must outlive
    /// it.
    SampledRows(const LoweredScene& picture, const ViewChains& chains, RegionState& state, int width);

    /// Appends chords for what lies between two heights of a band: `numbers` are that band's chains. They run
    /// down the sides of pixels.
    void run(std::span<const std::uint32_t> numbers, float top, float bottom,
             std::vector<asset::Chord>& chords);

private:
    using Layer = SolidLayers::Layer;

    /// A row of squares, and how many of these a pixel is wide.
    struct Row {
        float top, bottom;
        float along;

        /// Of y: 0 at the top, 1 at the bottom.
        float heightOf(float y) const { return (y - top) / (bottom - top); }
        glm::vec2 inSquares(glm::vec2 p) const { return {p.x * along, heightOf(p.y)}; }
        /// dx / dy
        float inSquares(float slope) const { return slope * along * (bottom - top); }
    };
    /// Where a chain goes in a row of squares.
    struct Touch {
        std::int32_t first, last;  ///< squares; -1 is left of the picture
        std::uint32_t cut;         ///< of cuts_
        std::int32_t winding;
        float top, bottom;                           ///< between these
        RowLine line;                                ///< from where it enters to where it leaves
        bool spans;                                  ///< the row
        bool isStraight;                             ///< it is a single edge there
        std::uint32_t firstPiece = 0, endPiece = 0;  ///< of pieces_; none until they are asked for
    };
    /// Squares [first, end), which chains of a layer touch, and the winding numbers beside them.
    struct Run {
        std::span<Touch> touches;
        std::int32_t first, end;
        std::int32_t windingLeft, windingRight;
    };
    /// An edge of a touch.
    struct Piece {
        PlacedEdge edge;
        PlaceRange range;
        bool spans;
        float left, right;  ///< in the row
    };
    enum class Side : std::uint8_t { In, Left, Right };  ///< of a square
    /// How far a chain is right of a line, at least and at most.
    struct Apart {
        float least, most;
    };

    int drawFirst(float top, float bottom);
    int drawPixels(float top, float bottom, int along);
    std::size_t endOfLayer(std::size_t first) const;
    bool isDense(std::size_t chains) const;
    void take(float top, float bottom);
    void drawRow();
    void drawDense(std::span<CutChain> cuts, const Layer& layer);
    void addSteps(const CutChain& cut);
    void lookAt(std::uint32_t number);
    void sortTouches();
    void drawTouched(const Layer& layer);
    void cover(std::int32_t square, const Layer& layer);
    void drawBetween(std::int32_t first, std::int32_t end, const Layer& layer);
    void drawRun(const Run& run, const Layer& layer);
    void leaveBehind(std::int32_t square, std::int32_t& winding, bool& hasEnds);
    bool drawOne(Touch& touch, std::int32_t square, std::int32_t winding, const Layer& layer);
    bool isDarkBetween(const Touch& left, const Touch& right, std::int32_t square, std::int32_t winding,
                       const Layer& layer) const;
    template <class Visit>
    void visitParts(const Touch& touch, std::int32_t square, const Visit& visit) const;
    Apart apartFrom(const RowLine& line, const Touch& touch, std::int32_t square, Side without) const;
    bool isDarkBeside(const Touch& touch, std::int32_t square, bool isLeft) const;
    void keepDark(std::int32_t square, const Touch& touch, bool isLeft);
    void findPieces(Touch& touch);
    void forgetPieces();
    void addTouch(Touch& touch, std::int32_t square);
    void finishRow(float top, float bottom, std::vector<asset::Chord>& chords);

    const int height_;
    const glm::vec2* const vertices_;
    RegionState& state_;
    const int width_;
    const SolidLayers solids_;
    SquareLights lights_;
    ChainTaker taker_;
    std::vector<CutChain> cuts_;  ///< from the topmost layer down
    Row row_{};
    float asked_ = 0;              ///< squares in which places were asked, and what takes as long
    float covered_ = 0;            ///< the same of squares all of which layers covered
    std::vector<glm::vec4> sums_;  ///< by pixel
    // Of a layer in the row.
    std::vector<Touch> touches_, arranged_;
    std::vector<Placed> order_, spare_;
    std::vector<Touch*> active_;  ///< touches of the square, and some that end on its left
    std::vector<Piece> pieces_, kept_;
    PlaceWindings onLeft_, windings_;
    std::optional<PlaceSteps> steps_;
};

}  // namespace vtm::compiler

/// \file
/// The chains of a band of rows in, the chords between its regions out: planarity where a picture is looked
/// at, and no further.
///
/// A line goes down the rows, and the chains that it cuts are kept in their order from left to right, each
/// with the set of layers on its right. It goes in *slabs*. Where no chain begins, ends or crosses another
/// between the top and the bottom of a slab, nothing changes but where the chains are. Around the places
/// where something does, the few chains near it are swept on their own, from vertex to vertex and from
/// crossing to crossing.
///
/// In each row the changes of paint add up, since every label follows from the one on its left. So no
/// rounding of a crossing lets a region leak: it moves an edge, it changes no label.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compiler/containers/min_tree.hpp"
#include "compiler/direct/line_sweep.hpp"
#include "compiler/direct/outline_rows.hpp"
#include "compiler/direct/quiet_chains.hpp"
#include "compiler/direct/region_state.hpp"
#include "compiler/direct/sampled_rows.hpp"
#include "compiler/direct/view_chains.hpp"
#include "raster/chord.hpp"

namespace vtm::compiler {

/// Bands that are swept on from the one above; then a new strip begins.
inline constexpr int stripBands = 4;

/// For one thread.
class BandSweep {
public:
    /// `state` is outside of all layers, and is so again after each band. All must outlive it.
    BandSweep(const LoweredScene& picture, const ViewChains& chains, RegionState& state, PixelColors& pixels,
              int width);

    /// Appends the chords of a band; their paints are the state's. Sweeps on from the band above, or begins
    /// anew, which it must where the state has forgotten paints.
    void run(int band, bool begins, std::vector<asset::Chord>& chords);

private:
    static constexpr float never = std::numeric_limits<float>::infinity();
    /// Slabs are halved where sweeping takes more than looking at all chains, down to this share of a row, or
    /// until so many chains are looked at in a row.
    static constexpr float leastHeight = 1.0f / 64;
    static constexpr float looksInRow = 1 << 20;

    /// A chain that the line cuts. What a look needs comes first.
    struct alignas(64) Active {
        glm::vec2 a, b;  ///< ends of the edge that the line cuts; the lower one is below the line
        float slope;
        float x;                ///< at the line
        float next;             ///< where the line goes to; at the line when it is there
        std::uint32_t at, end;  ///< vertices: that above the line, and the chain's end
        std::uint32_t bends;    ///< between: its vertices
        bool isBent;            ///< between: whether it has a vertex
        std::uint32_t layer;
        std::int32_t winding;
        std::int32_t before;  ///< winding number of its layer on its left
        float from;           ///< since where its sides have the paints `drawn`
        RegionPaint drawn[2];
        Region region;      ///< on its right
        std::uint64_t key;  ///< of the set there

        float xAt(float y) const { return y >= b.y ? b.x : y <= a.y ? a.x : a.x + (y - a.y) * slope; }
    };
    /// The columns between which a chain stays in a slab.
    struct Columns {
        float left = never, right = -never;
    };
    struct Reach : Columns {
        float last = 0;  ///< at the bottom, or where it ends
        bool ends = false;
        std::uint32_t bends = 0;

        void add(float x) {
            left = std::min(left, x);
            right = std::max(right, x);
            last = x;
        }
    };
    struct Slab {
        float top, bottom;
    };
    /// Where something happens in a slab: of x, and the active chains that it concerns, [first, end).
    struct Event {
        float left, right;
        std::size_t first, end;
        std::uint32_t begins;   ///< a chain, or noIndex
        bool isCrossing;        ///< and nothing else
        std::size_t bends = 0;  ///< vertices of what begins
    };
    struct Crossed {
        std::uint32_t layer;
        std::int32_t winding;
    };

    static bool isLeft(const Active* a, const Active* b);
    static bool isLeftThere(const Active* a, const Active* b) { return a->x < b->x; }
    static bool isLeftNext(const Active* a, const Active* b) { return a->next < b->next; }
    void addReach(Reach& reach, std::uint32_t at, std::uint32_t end, float bottom) const;
    Active* activate(std::uint32_t chain);
    void release(Active& active);
    void releaseAll();
    bool nextEdge(Active& active) const;
    void begin(std::span<const std::uint32_t> chains, float top);
    bool slab(Slab slab);
    std::size_t mayTake(float y) const;
    bool mayBeThinner(float y) const;
    bool isTangled(float y);
    void leave(float y);
    void passOn(std::span<const std::uint32_t> chains, float top, float bottom);
    void look(Slab slab);
    Columns lookAt(Active& active, std::size_t number, float bottom);
    bool isOrdered(const Active& left, const Active& right, float bottom) const;
    void lookAtBeginning(Slab slab);
    bool gather();
    std::size_t stepsOfGroups(float bottom);
    std::size_t heights(const Event& group, float bottom);
    void sweepGroups(Slab slab);
    void pass(std::size_t end, std::size_t& bent, float bottom);
    void passBends(Active& active, float bottom);

    bool mayReorder(Slab slab);
    void reorder(Slab slab);
    void sweep(Slab slab);
    bool mayReorderMembers(std::size_t first, std::size_t end);
    void reorderMembers(std::size_t first, std::size_t end, float y);
    bool areManyCrossings(std::size_t first, std::size_t end);
    bool crossWithoutQuiet(std::size_t first, std::size_t end, float y);
    void cross(std::size_t first, std::size_t end, float y);
    void sortRoughly(std::size_t first, std::size_t end, float y);
    void relabel(std::size_t first, std::size_t end, float y);
    Region regionAfter(std::size_t at, const Region& left, std::uint64_t keyLeft);
    void crossWindow(std::size_t first, std::size_t end, float y);
    void enterSweep();
    const Region& regionLeftOf(std::size_t member) const;
    std::uint64_t keyLeftOf(std::size_t member) const;
    void meetVertices(float y);
    void addStarting(float y);
    void label(float y);
    void moveTo(float y);
    std::uint64_t keyRightOf(const Active& member, std::uint64_t keyLeft, float y) const;
    void swap(std::size_t at, float y);
    void openWindow(std::span<Active* const> chains);
    template <class IsOrdered>
    bool isQuiet(std::span<Active* const> chains, const Region& left, const IsOrdered& isOrdered) const;
    bool staysHidden(std::span<Active* const> chains, const Region& left) const;
    void knowWindingLeftOf(std::uint32_t layer);

    void crossMembers(std::size_t count);
    void keepState(std::size_t members);
    void moveState(std::size_t done);

    void setSides(Active& active, RegionPaint left, RegionPaint right, float y);
    void draw(const Active& active, float from, float to);

    const ViewChains& chains_;
    const glm::vec2* const vertices_;
    RegionState& state_;
    std::vector<asset::Chord>* chords_ = nullptr;

    std::deque<Active> pool_;
    std::vector<Active*> free_;              ///< of pool_
    std::vector<Active*> active_;            ///< from left to right
    std::vector<Columns> columns_;           ///< theirs in the slab
    std::vector<std::size_t> bent_;          ///< the numbers of those that have a vertex in the slab
    std::vector<Active*> done_;              ///< those that have reached the bottom of the slab
    std::span<const std::uint32_t> toCome_;  ///< chains that begin below the line, from the top
    std::vector<std::uint32_t> beginning_;   ///< in the slab
    std::vector<Event> events_, groups_;
    std::size_t steps_ = 0;       ///< of sweeps in the slab
    std::size_t wouldTake_ = 0;   ///< before it was swept
    std::size_t stripSteps_ = 0;  ///< of looks and sweeps since it began anew
    float stripTop_ = 0;
    OutlineRows outline_;
    LineSweep lines_;
    std::optional<SampledRows> sampled_;  ///< where there are only colours
    std::size_t share_ = 1;               ///< of what a sweep may take else
    std::size_t mostInSlab_, crossedInStep_;
    bool isPassedOver_ = false;     ///< the last band, which `outline_` has drawn
    std::size_t passedOn_ = 0;      ///< chains of the band that was passed on, if the last one was
    float height_ = 1;              ///< of slabs
    float thinnest_ = leastHeight;  ///< of slabs with as many chains as now

    // Of a sweep.
    std::vector<Active*> members_, merged_, added_;
    std::vector<std::uint32_t> starting_;  ///< chains, from the bottom
    float line_ = 0;
    MinTree meets_;             ///< where members i and i + 1 cross, from the line on
    std::vector<float> least_;  ///< at the next vertex, of the members from i on
    Region leftRegion_;
    std::uint64_t leftKey_ = 0;
    struct Winding {
        std::uint64_t sweep = 0, window = 0;  ///< in which it is known
        std::int32_t left = 0;                ///< of the members of the sweep
        std::int32_t now = 0;                 ///< of the chains of the window, and on the way through them
        std::int32_t least = 0, most = 0;     ///< between these, whatever their order
        std::uint32_t chains = 0;             ///< that are active
    };
    std::vector<Winding> windings_;  ///< by layer
    std::uint64_t sweepNumber_ = 0, windowNumber_ = 0;
    std::vector<float> sorted_, merging_;  ///< of isTangled(), areManyCrossings() and heights()

    // While the quiet chains of a window are set aside.
    QuietChains quiet_;
    bool isQuietAside_ = false;
    std::vector<Active*> aside_;  ///< all members meanwhile
    std::vector<ReachingChain> reaching_;
    std::vector<std::int32_t> quietLefts_;  ///< of members: what quiet chains on their left added

    // Where the state is: right of so many chains that are done, and from there of so many members.
    std::vector<Crossed> crossedDone_, crossedMembers_;
};

}  // namespace vtm::compiler

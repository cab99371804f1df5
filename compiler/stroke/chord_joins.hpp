/// \file
/// Joins whose sides are chords: vertices that need not be there.
#pragma once

#include <cstddef>

#include "compiler/lower/area_chords.hpp"
#include "compiler/stroke/offset.hpp"

namespace vtm::compiler::stroke {

/// Through a join's vertex on the inner side, and to the next offset.
struct Detour {
    Side* side = nullptr;
    std::size_t at = 0;  ///< the vertex, in the side's ends
};
/// Of a mitre.
struct Tip {
    Side* side = nullptr;
    std::size_t at = 0;                                ///< in the side's ends
    bool isAfterChord = false, isBeforeChord = false;  ///< with their ends in between
};
struct ChordJoin {
    Point before{0, 0}, after{0, 0};  ///< unit tangents
    Tip tip;
    Detour detour;
};

/// Once the second segment's sides are there: goes straight from chord to chord on the inner side if these
/// cross in the half of each that is nearer to the join. Leaves the chords' ends beside the tip out if that
/// misplaces a quarter of the tolerance's area, or without one strays by no more than `gap`; the tip moves,
/// so that the area stays.
void shorten(const ChordJoin& join, const ChordTolerance& tolerance, double gap);

}  // namespace vtm::compiler::stroke

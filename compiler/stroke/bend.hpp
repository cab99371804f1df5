/// \file
/// Where a curve bends more tightly than half a stroke's width.
#pragma once

#include <vector>

#include "compiler/stroke/curve.hpp"

namespace vtm::compiler::stroke {

/// What a stretch of the curve is to a stroke: gentle, or bent more than the radius to one side.
enum class Bend { Gentle, Left, Right };

struct Span {
    double t0, t1;
    Bend bend;
    bool isFold = false;  ///< tight, but its evolute is all but a line, there and back
};

struct BendOptions {
    double radius;
    double slack;  ///< up to so many times the limit of the curvature counts as gentle
    /// In radians: stretches at the two ends that together turn by less count as gentle, however tight.
    double smallTurn;
};

/// Whether bounds of its curvature tell that a curve is gentle.
bool isSurelyGentle(const Curvature& k, double radius, double slack);

/// The whole curve in spans whose bends differ from one to the next.
std::vector<Span> bends(const Cubic& c, const BendOptions& options);

inline bool isGentle(const std::vector<Span>& spans) {
    return spans.size() == 1 && spans.front().bend == Bend::Gentle;
}

/// The same spans, the tight ones gentle if they turn by no more than `smallTurn`.
std::vector<Span> withoutSmallTurns(const Cubic& c, const std::vector<Span>& spans, double smallTurn);

/// By how much a stretch turns, if less than a whole turn.
double turnOf(const Cubic& c, const Span& span);

/// The same spans, the tight ones but folds cut where the curvature has extremes, unless the piece would turn
/// by less than `smallTurn`, and then at multiples of 45° so that none turns by more than 67.5°.
std::vector<Span> cutTight(const Cubic& c, const std::vector<Span>& spans, double smallTurn);

}  // namespace vtm::compiler::stroke

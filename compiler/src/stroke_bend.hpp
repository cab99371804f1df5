/// \file
/// Where a curve bends more tightly than half a stroke's width.
#pragma once

#include <vector>

#include "compiler/src/stroke_curve.hpp"

namespace vtm::compiler::stroke {

/// What a stretch of the curve is to a stroke: gentle, or bent more than the radius to one side.
enum class Bend { Gentle, Left, Right };

struct Span {
    double t0, t1;
    Bend bend;
};

struct BendOptions {
    double radius;
    double slack;  ///< up to so many times the limit of the curvature counts as gentle
    /// In radians: stretches at the two ends that together turn by less count as gentle, however tight.
    double smallTurn;
};

/// The whole curve in spans whose bends differ from one to the next.
std::vector<Span> bends(const Cubic& c, const BendOptions& options);

inline bool isGentle(const std::vector<Span>& spans) {
    return spans.size() == 1 && spans.front().bend == Bend::Gentle;
}

/// The same spans, the tight ones cut where the curvature has extremes and where the tangent passes a
/// multiple of 45°, unless the piece would turn by less than `smallTurn`.
std::vector<Span> cutTight(const Cubic& c, const std::vector<Span>& spans, double smallTurn);

}  // namespace vtm::compiler::stroke

/// \file
/// Stroke style. Source: SVG 2 section 13.5, OpenVG 1.1 section 8.7.
#pragma once

#include <vector>

#pragma GCC visibility push(default)

namespace vtm::scene {

enum class Cap { Butt, Round, Square };
/// MiterClip cuts a mitre at the limit instead of turning it into a bevel (SVG 2).
enum class Join { Miter, MiterClip, Round, Bevel };

/// Lengths are in the path's own space, before the item's transform: a stroke is made first and
/// transformed after.
struct StrokeStyle {
    double width = 1;  ///< > 0
    Cap cap = Cap::Butt;
    Join join = Join::Miter;
    double miterLimit = 4;  ///< >= 1: mitre length / stroke width
    /// Lengths of dash, gap, dash, … repeated; an odd list is already doubled by the importer. Empty:
    /// solid. Each >= 0, the sum > 0.
    std::vector<double> dashes;
    double dashPhase = 0;  ///< where in the pattern each subpath starts
    friend bool operator==(const StrokeStyle&, const StrokeStyle&) = default;
};

}  // namespace vtm::scene

#pragma GCC visibility pop

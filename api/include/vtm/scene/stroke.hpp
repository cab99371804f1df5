/// \file
/// Stroke style. Source: SVG 2 section 13.5, OpenVG 1.1 section 8.7.
#pragma once

#include <vector>

#pragma GCC visibility push(default)

namespace vtm::scene {

enum class Cap { Butt, Round, Square };
/// A mitre beyond the limit becomes a bevel with Miter; with MiterClip it is cut at the limit (SVG 2).
enum class Join { Miter, MiterClip, Round, Bevel };

/// Lengths are in the path's own space: the stroke is made first and then transformed by the item's
/// transform. All numbers must be finite.
struct StrokeStyle {
    double width = 1;  ///< > 0
    Cap cap = Cap::Butt;
    Join join = Join::Miter;
    double miterLimit = 4;  ///< max of mitre length / stroke width, >= 1
    /// Lengths of dash, gap, dash, … which repeat. Their number is even (importers double odd lists), each is
    /// >= 0, and their sum is > 0. Empty: a solid stroke.
    std::vector<double> dashes;
    double dashPhase = 0;  ///< the position in the pattern at which each subpath starts
    friend bool operator==(const StrokeStyle&, const StrokeStyle&) = default;
};

}  // namespace vtm::scene

#pragma GCC visibility pop

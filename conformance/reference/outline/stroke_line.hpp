/// \file
/// The lines that a stroke follows, before they get their width.
#pragma once

#include <optional>
#include <vector>

#include <vtm/scene/stroke.hpp>
#include "conformance/reference/outline/flatten.hpp"

namespace vtm::reference {

/// The samples of one curve, at least two. Where one run ends and the next begins is a join.
using Run = std::vector<Sample>;

/// A subpath or a dash. One of no length is a single run of two equal points.
struct StrokeLine {
    std::vector<Run> runs;
    bool closed = false;
};

/// The flattened subpaths. Curves of no length are left out; a subpath of nothing else becomes a line
/// of no length along the x axis (SVG 2 section 13.6.2). A lone MoveTo gives nothing.
std::vector<StrokeLine> strokeLinesOf(const scene::Path& path, const Fineness& fineness);

/// The dashes of the lines. One that runs over a closed line's start is one dash, and closed if it is
/// as long as the line. What lies outside the fineness' view may be missing. Nothing if there were more
/// than maxDashes.
std::optional<std::vector<StrokeLine>> dash(const std::vector<StrokeLine>& lines,
                                            const scene::StrokeStyle& style, const Fineness& fineness);

}  // namespace vtm::reference

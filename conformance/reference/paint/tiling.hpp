/// \file
/// Which tiles of a pattern show.
#pragma once

#include <optional>
#include <vector>

#include <vtm/scene/paint.hpp>
#include "conformance/reference/outline/geometry.hpp"

namespace vtm::reference {

/// For each tile that meets the region (pixels) the map from pattern space, moved to that tile, to
/// pixels. Nothing if there may be more than `limit`, or if the pattern is flattened to a line.
std::optional<std::vector<Affine>> tilesMeeting(const Box& region, const scene::Pattern& pattern,
                                                const Affine& patternToPixels, double limit);

/// Items in a group, those in its groups included; at least one.
std::size_t itemCount(const scene::Group& group);

}  // namespace vtm::reference

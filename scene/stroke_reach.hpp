/// \file
/// How far a stroke reaches.
#pragma once

#include <algorithm>
#include <numbers>

#include <vtm/scene/stroke.hpp>

namespace vtm::scene {

/// From its path, at most, dashes filled in: as far as the longest mitre that the style allows, or the corner
/// of a square cap.
inline double strokeReach(const StrokeStyle& stroke) {
    const bool isMitred = stroke.join == Join::Miter || stroke.join == Join::MiterClip;
    return stroke.width / 2 * std::max(isMitred ? stroke.miterLimit : 1.0, std::numbers::sqrt2);
}

}  // namespace vtm::scene

/// \file
/// The mask of a recording: not pixels, but what they would be made of.
#pragma once

#include <memory>
#include <optional>

#include <vtm/scene/scene.hpp>

namespace vtm::openvg {

/// Its value at a point: 1 in the clip and 0 outside, times the group's alpha. Null: 1 everywhere.
struct RecordedMask {
    std::shared_ptr<const scene::Clip> clip;
    std::shared_ptr<const scene::Group> alpha;

    friend bool operator==(const RecordedMask&, const RecordedMask&) = default;
};

RecordedMask emptyMask();
RecordedMask maskOf(scene::ClipShape shape);

/// Table 5 of the specification; `picture` is the outline of all there is.
RecordedMask unionOf(const RecordedMask& a, const RecordedMask& b,
                     const std::shared_ptr<const scene::Path>& picture);
RecordedMask intersectionOf(const RecordedMask& a, const RecordedMask& b,
                            const std::shared_ptr<const scene::Path>& picture);
/// Nothing unless b is one shape, all or nothing: scenes have no complement of anything else.
std::optional<RecordedMask> differenceOf(const RecordedMask& a, const RecordedMask& b,
                                         const std::shared_ptr<const scene::Path>& picture);

}  // namespace vtm::openvg

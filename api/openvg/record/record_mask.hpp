/// \file
/// What a recording's layers are cut to: outlines of shapes, and the mask, which is not pixels, but what they
/// would be made of.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "api/openvg/state/objects.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

scene::Path rectangleOf(double x, double y, double width, double height);

/// Scissoring rectangles that hold something: x, y, width, height. The corners may be beyond what integers
/// hold.
std::vector<VGint> rectanglesOf(const State& state);

/// Of all rectangles, to be filled by the non-zero rule.
scene::Path outlineOf(const std::vector<VGint>& rectangles);

/// Where a path is painted, in its own space; an empty path where it is nowhere.
scene::Shape shapeOf(const State& state, const Path& path, VGPaintMode mode, const scene::Affine& transform);

/// Its value at a point: 1 in the clip and 0 outside, times the group's alpha. Null: 1 everywhere.
struct RecordedMask {
    std::shared_ptr<const scene::Clip> clip;
    std::shared_ptr<const scene::Group> alpha;
    bool isShare = false;  ///< values may be between 0 and 1

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

/// `mask` combined with the alpha of an item, where the item is; elsewhere it stays. For VG_SUBTRACT_MASK the
/// item's alpha is what the mask is multiplied by.
RecordedMask combinedWith(const RecordedMask& mask, VGMaskOperation operation, const scene::Item& inside,
                          const std::shared_ptr<const scene::Path>& picture);

}  // namespace vtm::openvg

/// \file
/// A path's masks: filled by either rule, and stroked in the styles that were asked for last.
#pragma once

#include <deque>
#include <memory>

#include <vtm/scene/stroke.hpp>
#include "api/openvg/draw/path_mask.hpp"
#include "api/openvg/path/path_data.hpp"

namespace vtm::openvg {

/// Section 8.7.3, ranges applied: width > 0, miterLimit >= 1, no dash below 0, an even number of them.
struct StrokeParameters {
    scene::StrokeStyle style;
    bool dashPhaseReset = false;  ///< every subpath starts the pattern anew

    friend bool operator==(const StrokeParameters&, const StrokeParameters&) = default;
};

/// Of one state of a path's data: clear() when it changes.
class PathMasks {
public:
    PathMask& filled(const PathData& path, scene::FillRule rule);
    PathMask& stroked(const PathData& path, const StrokeParameters& parameters);
    void clear();

private:
    struct Stroke {
        StrokeParameters parameters;
        std::unique_ptr<PathMask> mask;
    };

    std::unique_ptr<PathMask> nonZero_, evenOdd_;
    std::deque<Stroke> strokes_;  ///< the last used first
};

/// The stroke's outline, to be filled by the non-zero rule (section 8.7.4).
scene::Path strokeOutline(const PathData& path, const StrokeParameters& parameters);

}  // namespace vtm::openvg

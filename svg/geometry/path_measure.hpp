/// \file
/// Points at distances along a path.
#pragma once

#include <variant>
#include <vector>

#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {

/// Distances run over all subpaths in turn; the jumps between them have no length.
class PathMeasure {
public:
    explicit PathMeasure(const scene::Path& path);

    double length() const { return length_; }  ///< within 1e-9 of itself
    /// The path ends where it began.
    bool closed() const { return closed_; }

    struct Place {
        scene::Point at;
        glm::dvec2 direction;  ///< of length 1
    };
    /// Beyond its ends the path goes on straight. The path has a length.
    Place at(double distance) const;

private:
    using Segment = std::variant<LineSegment, geometry::Cubic, ArcSegment>;
    struct MeasuredSegment {
        Segment segment;
        double start, length;
    };

    std::vector<MeasuredSegment> segments_;  ///< of lengths > 0
    double length_ = 0;
    bool closed_ = false;
};

}  // namespace vtm::svg

/// \file
/// From pictures to an outcome: every view of a subject, drawn by every engine, against the expected picture.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "conformance/runner/suite/case.hpp"

namespace vtm::conformance {

/// What may differ at most, of premultiplied channels in 1/255.
struct Bounds {
    static constexpr double any = std::numeric_limits<double>::infinity();
    double max = any, mean = any, rms = any, p999 = any;
    /// The largest difference in pixels that look like all their neighbours in the expected picture: seams,
    /// streaks and cracks show there and nowhere else.
    double flat = any;
    /// The largest difference of Gl and Scan from Asset: three routes of one asset.
    double twin = any;
};

/// Differences and the bound they break, if any. Pictures of different sizes break all.
Figure measure(const image::Raster& expected, const image::Raster& drawn, const Bounds& bounds);

/// Something that can be drawn: the one seam for kinds of cases that are about pictures. A kind of its own
/// (calls of an API, say) derives from this and gets views, bounds, faults and reports with it.
class Subject {
public:
    virtual ~Subject() = default;

    virtual std::size_t views() const = 0;
    virtual std::string labelOf(std::size_t view) const = 0;
    virtual std::vector<Engine> engines(std::size_t view) const = 0;
    virtual Bounds bounds(Engine engine) const = 0;
    virtual image::Raster expected(std::size_t view) = 0;
    virtual image::Raster drawn(std::size_t view, Engine engine) = 0;
};

/// Fails if any engine breaks a bound in any view. Skipped if no engine of the setting draws it.
Outcome judge(Subject& subject, const Setting& setting);

}  // namespace vtm::conformance

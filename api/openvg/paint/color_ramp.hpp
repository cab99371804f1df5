/// \file
/// Colours along a gradient (specification section 9.3.3).
#pragma once

#include <vector>

#include <VG/openvg.h>

#include "api/openvg/paint/color.hpp"
#include "api/openvg/state/objects.hpp"

namespace vtm::openvg {

class ColorRamp {
public:
    explicit ColorRamp(const Paint& paint);

    /// Of the first stop, that of offset 0 if none is given: as at() gives them.
    Color first() const {
        return premultiplied_ ? stops_.front().color : premultiplied(stops_.front().color);
    }

    /// Of what at() gives: premultiplied, sRGBA unless the paint's ramp is linear (VG_NDS_paint_generation).
    ColorSpace space() const { return space_; }

    /// At a gradient's value, any number.
    Color at(double offset) const;

    struct Stop {
        float offset;
        Color color;  ///< premultiplied if the ramp's are
    };
    /// From offset 0 to 1, at least two.
    const std::vector<Stop>& stops() const { return stops_; }
    /// As at(), of a place between two neighbours: 0 at a, 1 at b.
    Color between(const Stop& a, const Stop& b, float t) const {
        const Color color = glm::mix(a.color, b.color, t);
        return premultiplied_ ? color : premultiplied(color);
    }

private:
    std::vector<Stop> stops_;
    ColorSpace space_;
    VGColorRampSpreadMode spread_;
    bool premultiplied_;  ///< colours of stops are, and so is what lies between
};

}  // namespace vtm::openvg

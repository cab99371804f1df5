/// \file
/// A gradient's colours along its offset.
#pragma once

#include <vector>

#include <vtm/scene/paint.hpp>
#include "conformance/reference/paint/blend.hpp"

namespace vtm::reference {

Colour premultiplied(const Colour& straight);
Colour premultiplied(const scene::Color& color);

class Ramp {
public:
    Ramp(std::vector<scene::GradientStop> stops, scene::Spread spread);
    /// Before the first stop its colour, after the last its. Where stops coincide the last one holds.
    Colour at(double offset) const;
    /// The mean over offset + x + y with x evenly within ± a / 2 and y within ± b / 2; a, b >= 0. Exact where
    /// a stop lies there, else the colour in the middle.
    Colour over(double offset, double a, double b) const;
    bool isOpaque() const;

private:
    /// A straight line of d.
    struct Weight {
        double at0 = 1, slope = 0;
        double operator()(double d) const { return at0 + slope * d; }
    };

    std::size_t stopsUpTo(double offset) const;
    bool hasStop(double from, double to) const;
    Colour between(std::size_t upTo, double offset) const;
    Colour withinPeriod(double origin, double from, double to, const Weight& weight) const;
    Colour integral(double origin, double from, double to, const Weight& weight) const;

    std::vector<scene::GradientStop> stops_;  ///< of a whole period, of reflected ramps a rise and a fall
    double period_;                           ///< 0: padded
    Colour mean_{0};                          ///< over a period
};

}  // namespace vtm::reference

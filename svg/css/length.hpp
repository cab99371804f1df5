/// \file
/// Lengths: numbers with units and percentages. Source: SVG 2 section 8.9, CSS Values 4.
#pragma once

#include <optional>
#include <string_view>

#include "svg/css/cursor.hpp"

namespace vtm::svg {

/// What percentages refer to: the nearest viewport, user units.
struct Viewport {
    double width = 0, height = 0;
    friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// What the other relative units refer to.
struct Units {
    double dpi = 96;
    double fontSize = 12, rootFontSize = 12;
    double fontWeight = 400;  ///< the parent's, for `bolder` and `lighter`
    Viewport root;            ///< for vw and vh
    double mediumFontSize = 12;
    std::optional<double> whole{};  ///< what percentages are of, where that is known
};

/// User units, or a percentage of something that is known only where it is used.
struct Length {
    double value = 0;
    bool percent = false;
    double plus = 0;  ///< user units on top of a percentage, as calc() may have it

    /// Of what percentages refer to.
    double of(double whole) const { return percent ? value / 100 * whole + plus : value; }
};

enum class Axis { X, Y, Diagonal };

std::optional<Length> readLength(Cursor& cursor, const Units& units);
/// The whole text, surrounding spaces aside.
std::optional<Length> parseLength(std::string_view text, const Units& units);
/// Whether it is one, also where percentages and lengths compare, which is known only where it is used.
bool isAnyLength(std::string_view text, Units units);
/// The same, and not negative as far as that can be told.
bool isNotNegative(std::string_view text, const Units& units);
double resolve(Length length, Axis axis, const Viewport& viewport);

/// A number or a percentage as a fraction.
std::optional<double> parseFraction(std::string_view text);
/// Degrees in one of a unit of angles; nothing for others.
std::optional<double> degreesIn(std::string_view unit);
/// Degrees from a number with an optional CSS angle unit.
std::optional<double> readAngle(Cursor& cursor);

}  // namespace vtm::svg

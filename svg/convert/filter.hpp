/// \file
/// Filters, from their elements and functions to the scene's values. Source: Filter Effects Module Level 1.
#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "svg/css/filter_values.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/transform.hpp"
#include "svg/xml/element.hpp"

namespace vtm::svg {

/// What a filter function stands for; its region is everything.
scene::Filter filterOf(const FilterFunction& function, const scene::Color& color,
                       const scene::Affine& transform);

/// How numbers of filter primitives become user units: as they are, or as shares of the box of what is
/// filtered (primitiveUnits).
struct PrimitiveUnits {
    bool ofBox = false;
    Box box;

    double x(double v) const { return ofBox ? v * box.width() : v; }
    double y(double v) const { return ofBox ? v * box.height() : v; }
    /// Along no axis.
    double length(double v) const;
    double placeX(double v) const { return ofBox ? box.min.x + v * box.width() : v; }
    double placeY(double v) const { return ofBox ? box.min.y + v * box.height() : v; }
};

/// Numbers with spaces or commas between; nothing if there is anything else.
std::optional<std::vector<double>> parseNumbers(std::string_view text);
/// One number; `fallback` where it is absent or anything else.
double numberOf(const Element& element, std::string_view name, double fallback);

/// The operation of a primitive that needs nothing but its own attributes, its children's and its style: all
/// but feImage. Nothing for names that are unknown. `isFailed`: it is in error and transparent black instead.
std::optional<scene::FilterOperation> filterOperation(const Element& element, const Style& style,
                                                      const PrimitiveUnits& units, bool& isFailed);

/// How many inputs the attributes `in` and `in2` give; nothing for feMerge, whose children have them.
std::optional<std::size_t> inputCount(const scene::FilterOperation& operation);

}  // namespace vtm::svg

/// \file
/// The `filter` property: references to filters, and filter functions. Source: Filter Effects Module Level 1,
/// section 6.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "svg/css/style.hpp"

namespace vtm::svg {

struct FilterReference {
    std::string_view href;
};

struct FilterFunction {
    enum class Kind {
        Blur,
        Brightness,
        Contrast,
        DropShadow,
        Grayscale,
        HueRotate,
        Invert,
        Opacity,
        Saturate,
        Sepia
    } kind = Kind::Blur;
    double amount = 1;                     ///< degrees of HueRotate; a fraction of those that take one
    double x = 0, y = 0, deviation = 0;    ///< user units, of Blur and DropShadow
    ColorValue color{true, {0, 0, 0, 1}};  ///< of DropShadow
};

using FilterValue = std::variant<FilterReference, FilterFunction>;

/// Nothing if the list is malformed. Empty for `none`.
std::optional<std::vector<FilterValue>> parseFilterList(std::string_view text, const Units& units);

}  // namespace vtm::svg

/// \file
/// Basic shapes as paths. Source: SVG 2 chapter 10.
#pragma once

#include <vtm/scene/path.hpp>
#include "svg/css/length.hpp"
#include "svg/css/style.hpp"
#include "svg/xml/element.hpp"

namespace vtm::svg {

/// Reads the lengths of an element: from CSS where that gives them, else from attributes.
struct LengthReader {
    const Element& element;
    const Style& style;
    const Viewport& viewport;
    Units units;

    /// As written; empty where absent.
    std::string_view text(std::string_view name) const;
    /// Nothing where it is absent, `auto` or malformed.
    std::optional<double> length(std::string_view name, Axis axis) const;
    double lengthOr(std::string_view name, Axis axis, double fallback) const {
        return length(name, axis).value_or(fallback);
    }
};

struct Shape {
    scene::Path path;       ///< empty: nothing to draw
    std::string problem{};  ///< what is wrong with the element; empty: nothing
};

bool isShape(Tag tag);
Shape makeShape(const LengthReader& reader);

}  // namespace vtm::svg

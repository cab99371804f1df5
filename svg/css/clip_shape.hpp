/// \file
/// The shapes that `clip-path` may name instead of an element. Source: CSS Shapes 1 section 3, CSS Shapes 2
/// section 3, CSS Masking 1 section 7.1.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include <vtm/scene/path.hpp>
#include "svg/css/length.hpp"
#include "svg/css/style.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/geometry/transform.hpp"

namespace vtm::svg {

/// `inset()`, `rect()`, `xywh()`: a rectangle with round corners.
struct ClipRectangle {
    enum class Sides { Inset, Rect, Xywh } sides = Sides::Inset;
    std::array<Length, 4> values{};            ///< in the order in which the function has them
    std::array<bool, 4> automatic{};           ///< of rect(): the sides of the box
    std::array<Length, 4> radiiX{}, radiiY{};  ///< from the top left corner, clockwise
};

/// `circle()`, `ellipse()`.
struct ClipEllipse {
    struct Radius {
        enum class Kind { Given, ClosestSide, FarthestSide } kind = Kind::ClosestSide;
        Length given;
    };
    bool isCircle = true;  ///< both radii are the first
    Radius x, y;
    TransformOrigin center{{50, true}, {50, true}};
};

struct ClipPolygon {
    std::vector<std::array<Length, 2>> points;
};

/// `path()`, in the units of the element, from the corner of the box.
struct ClipPathData {
    scene::Path path;
};

struct ClipShape {
    std::variant<ClipRectangle, ClipEllipse, ClipPolygon, ClipPathData> shape;
    scene::FillRule fillRule = scene::FillRule::NonZero;
    TransformBox box = TransformBox::Stroke;  ///< where the origin lies, and of what percentages are
};

/// Nothing if it is no shape and no box.
std::optional<ClipShape> parseClipShape(std::string_view text, const Units& units);

/// In the space in which the box is given.
scene::Path outlineOf(const ClipShape& shape, const Box& box);

}  // namespace vtm::svg

/// \file
/// What painters that draw a path at a time are given.
#pragma once

#include <variant>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/paint.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>

namespace vtm::bench {

/// A shape of one colour.
struct Shape {
    scene::Path path;
    scene::Affine toPicture = scene::identity;
    std::variant<scene::FillRule, scene::StrokeStyle> geometry = scene::FillRule::NonZero;
    scene::Color color{0.2f, 0.3f, 0.5f, 1};
};

}  // namespace vtm::bench

/// \file
/// What painters that draw a path at a time are given.
#pragma once

#include <variant>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/paint.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/scene/stroke.hpp>

namespace vtm::bench {

/// A shape of one colour.
struct Shape {
    scene::Path path;
    scene::Affine toPicture = scene::identity;
    std::variant<scene::FillRule, scene::StrokeStyle> geometry = scene::FillRule::NonZero;
    scene::Color color{0.2f, 0.3f, 0.5f, 1};
};

/// Arcs as cubics of at most a quarter turn, within 3e-4 of their radii.
scene::Path withoutArcs(const scene::Path& path);

/// A scene's, in the order of drawing, without arcs. Throws std::runtime_error where a group or a paint is
/// more than paths of one colour over each other.
std::vector<Shape> shapesOf(const scene::Scene& scene);

}  // namespace vtm::bench

/// \file
/// A scene while it is drawn by a family of hard scenes.
#pragma once

#include <memory>
#include <numbers>
#include <utility>

#include <vtm/scene/scene.hpp>
#include "conformance/generate/src/random.hpp"

namespace vtm::generate {

using std::numbers::pi;

inline scene::Point polar(scene::Point centre, double radius, double angle) {
    return centre + radius * scene::Point(std::cos(angle), std::sin(angle));
}
/// Turned by a quarter.
inline scene::Point across(scene::Point p) { return {-p.y, p.x}; }
/// Turned by `angle`, scaled by `sx` and `sy` first, about `centre`.
inline scene::Affine about(scene::Point centre, double angle, double sx, double sy) {
    const scene::Point x = sx * polar({}, 1, angle), y = sy * across(polar({}, 1, angle));
    return {x, y, centre - centre.x * x - centre.y * y};
}
inline void append(scene::Path& path, const scene::Path& more) {
    path.insert(path.end(), more.begin(), more.end());
}
scene::Path circle(scene::Point centre, scene::Point radii);

/// Drawn numbers must not depend on the order in which a compiler evaluates arguments: an expression draws
/// once, or within braces. Items are added to the root group unless they are drawn into another one.
class Sketch {
public:
    explicit Sketch(std::uint64_t seed, double width = 64, double height = 64)
        : random(seed), scene{width, height, {}} {}

    Random random;
    scene::Scene scene;

    double side() const { return std::max(scene.width, scene.height); }
    scene::Point size() const { return {scene.width, scene.height}; }
    /// In the picture, or a little outside.
    scene::Point point() { return random.point(-0.1, 1.1) * size(); }
    /// No nearer to the border than a share of the side.
    scene::Point inside(double margin = 0.2) { return random.point(margin, 1 - margin) * size(); }
    /// Opaque as often as not.
    scene::Color color();

    scene::Item& add(scene::Path path, std::variant<scene::FillRule, scene::StrokeStyle> geometry,
                     scene::Group* group = nullptr);
    scene::Item& fill(scene::Path path, scene::Group* group = nullptr) {
        return add(std::move(path), scene::FillRule::NonZero, group);
    }
    scene::Item& fillAny(scene::Path path, scene::Group* group = nullptr) {
        return add(std::move(path), random.any(scene::FillRule::EvenOdd), group);
    }
    /// Any join and cap, and a width between shares of a length; the picture's side unless one is given.
    scene::StrokeStyle style(double thinnest, double widest, double length);
    scene::StrokeStyle style(double thinnest, double widest) { return style(thinnest, widest, side()); }
    scene::Path anyCircle(double smallest = 0.05);
    scene::Path anyRectangle();
};

}  // namespace vtm::generate

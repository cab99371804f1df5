#include "tools/input/bounds.hpp"

#include <algorithm>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/stroke.hpp>
#include <vtm/limits/limits.hpp>
#include "geometry/arc.hpp"
#include "geometry/box.hpp"
#include "geometry/cubic.hpp"
#include "scene/center_form.hpp"

namespace vtm::tools {

namespace {

using geometry::Box;
using geometry::Cubic;
using scene::Affine;
using scene::Point;

/// The box of a mapped path. A MoveTo that nothing follows does not count.
class PathBox {
public:
    explicit PathBox(const Affine& transform) : transform_(transform) {}

    void operator()(const scene::MoveTo& move) { at_ = start_ = move.to; }
    void operator()(const scene::LineTo& line) { lineTo(line.to); }
    void operator()(const scene::QuadTo& quad) { curve(geometry::raised(at_, quad.control, quad.to)); }
    void operator()(const scene::CubicTo& cubic) { curve({at_, cubic.control1, cubic.control2, cubic.to}); }
    void operator()(const scene::ArcTo& arc) {
        if (const auto center = scene::centerForm(at_, arc))
            box_.add(geometry::bounds(geometry::mapped(*center, transform_)));
        lineTo(arc.to);
    }
    void operator()(const scene::Close&) { lineTo(start_); }
    const Box& box() const { return box_; }

private:
    Point map(Point p) const { return scene::apply(transform_, p); }
    void lineTo(Point to) {
        box_.add(map(at_));
        box_.add(map(to));
        at_ = to;
    }
    void curve(const Cubic& c) {
        box_.add(geometry::bounds(Cubic{map(c.p0), map(c.p1), map(c.p2), map(c.p3)}));
        at_ = c.p3;
    }

    const Affine transform_;
    Box box_;
    Point at_{0}, start_{0};
};

Box boxOf(const scene::Path& path, const Affine& transform) {
    PathBox box(transform);
    for (const scene::Command& command : path)
        std::visit(box, command);
    return box.box();
}

class SceneBox {
public:
    explicit SceneBox(double tolerance) : tolerance_(tolerance) {}

    void add(const scene::NodeList& nodes) {
        for (const scene::Node& node : nodes) {
            limits::check();
            std::visit([&](const auto& value) { add(value); }, node.value);
        }
    }
    const Box& box() const { return box_; }

private:
    void add(const scene::Item& item) { add(*item.path, item.transform, item.geometry); }
    void add(const scene::Group& group) { add(group.children); }
    void add(const scene::Select& select) {
        for (const scene::Group* side : {select.inside.get(), select.outside.get()})
            if (side)
                add(side->children);
    }
    void add(const scene::Path& path, const Affine& transform,
             const std::variant<scene::FillRule, scene::StrokeStyle>& geometry) {
        const auto* style = std::get_if<scene::StrokeStyle>(&geometry);
        box_.add(style ? boxOf(compiler::strokeOutline(path, *style, pathTolerance(transform)), transform)
                       : boxOf(path, transform));
    }
    /// In the path's units.
    double pathTolerance(const Affine& m) const {
        return tolerance_ / std::max({glm::length(m[0]), glm::length(m[1]), tolerance_});
    }

    const double tolerance_;
    Box box_;
};

}  // namespace

std::optional<scene::Rect> drawnBounds(const scene::Scene& scene) {
    SceneBox drawn(compiler::Options().tolerance * std::max(scene.width, scene.height));
    drawn.add(scene.root.children);
    const Box box = drawn.box().intersection({Point(0), Point(scene.width, scene.height)});
    if (!(box.min.x < box.max.x && box.min.y < box.max.y))
        return std::nullopt;
    return scene::Rect{box.min.x, box.min.y, box.width(), box.height()};
}

}  // namespace vtm::tools

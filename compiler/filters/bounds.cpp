#include "compiler/filters/bounds.hpp"

#include <algorithm>
#include <cmath>

#include "scene/stroke_reach.hpp"

namespace vtm::compiler {
namespace {

using geometry::Box;
using scene::Affine;
using scene::Point;

void addControls(const scene::Path& path, Box& box) {
    Point last(0);
    for (const scene::Command& command : path)
        std::visit(
            [&](const auto& c) {
                using C = std::decay_t<decltype(c)>;
                if constexpr (std::is_same_v<C, scene::QuadTo>) {
                    box.add(c.control);
                } else if constexpr (std::is_same_v<C, scene::CubicTo>) {
                    box.add(c.control1);
                    box.add(c.control2);
                } else if constexpr (std::is_same_v<C, scene::ArcTo>) {
                    // No point of an arc is farther from its start than the diameter of its longer axis.
                    const double diameter = 2 * std::max({std::abs(c.radii.x), std::abs(c.radii.y),
                                                          std::hypot(c.to.x - last.x, c.to.y - last.y)});
                    box.add(last - diameter);
                    box.add(last + diameter);
                }
                if constexpr (!std::is_same_v<C, scene::Close>) {
                    box.add(c.to);
                    last = c.to;
                }
            },
            command);
}

Box boundsOfItem(const scene::Item& item, const Affine& toPicture) {
    Box box;
    addControls(*item.path, box);
    if (box.empty())
        return box;
    if (const auto* stroke = std::get_if<scene::StrokeStyle>(&item.geometry)) {
        box.min -= scene::strokeReach(*stroke);
        box.max += scene::strokeReach(*stroke);
    }
    return geometry::mapped(box, scene::compose(toPicture, item.transform));
}

/// The tree of groups in a loop: they nest deep, and the stack may be small.
class Bounds {
public:
    explicit Bounds(const Affine& toPicture) : toPicture_(toPicture) {}

    Box run(const scene::NodeList& nodes) {
        waiting_.push_back(&nodes);
        while (!waiting_.empty()) {
            const scene::NodeList& list = *waiting_.back();
            waiting_.pop_back();
            for (const scene::Node& node : list)
                std::visit([this](const auto& value) { add(value); }, node.value);
        }
        return box_;
    }

private:
    void add(const scene::Item& item) { box_.add(boundsOfItem(item, toPicture_)); }
    void add(const scene::Group& group) {
        if (group.filter)
            box_.add(geometry::mapped({group.filter->min, group.filter->max},
                                      scene::compose(toPicture_, group.filter->transform)));
        else
            waiting_.push_back(&group.children);
    }
    void add(const scene::Select& select) {
        if (select.inside)
            waiting_.push_back(&select.inside->children);
        if (select.outside)
            waiting_.push_back(&select.outside->children);
    }

    const Affine& toPicture_;
    Box box_;
    std::vector<const scene::NodeList*> waiting_;
};

struct Reach {
    double deviations;

    Point operator()(const scene::GaussianBlurFilter& f) const { return blur(f.deviationX, f.deviationY); }
    Point operator()(const scene::DropShadowFilter& f) const {
        return blur(f.deviationX, f.deviationY) + Point(std::abs(f.dx), std::abs(f.dy));
    }
    Point operator()(const scene::OffsetFilter& f) const { return {std::abs(f.dx), std::abs(f.dy)}; }
    Point operator()(const scene::MorphologyFilter& f) const { return {f.radiusX, f.radiusY}; }
    Point operator()(const scene::DisplacementMapFilter& f) const { return Point(std::abs(f.scale)); }
    // Their pixels are of any size.
    Point operator()(const scene::ConvolveMatrixFilter&) const { return Point(HUGE_VAL); }
    Point operator()(const scene::LightingFilter&) const { return Point(HUGE_VAL); }
    Point operator()(const scene::TileFilter&) const { return Point(HUGE_VAL); }
    template <class Operation>
    Point operator()(const Operation&) const {
        return Point(0);
    }

private:
    Point blur(float x, float y) const { return deviations * Point(x, y); }
};

}  // namespace

Box boundsOf(const scene::NodeList& nodes, const Affine& toPicture) { return Bounds(toPicture).run(nodes); }

Point reachOf(const scene::Filter& filter, double deviations) {
    Point reach(0);
    for (const scene::FilterPrimitive& primitive : filter.primitives)
        reach += std::visit(Reach{deviations}, primitive.operation);
    return reach;
}

}  // namespace vtm::compiler

#include "compiler/session/same_nodes.hpp"

#include <algorithm>
#include <memory>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace vtm::compiler {
namespace {

using scene::Group;
using scene::Item;
using scene::Node;
using scene::NodeList;
using scene::Path;
using scene::Select;

/// The frames that a compilation makes have a path of their own each time.
constexpr std::size_t fewCommands = 6;

bool isSameCorner(const scene::Command& a, const scene::Command& b) {
    if (a.index() != b.index())
        return false;
    if (const auto* to = std::get_if<scene::MoveTo>(&a))
        return to->to == std::get<scene::MoveTo>(b).to;
    if (const auto* to = std::get_if<scene::LineTo>(&a))
        return to->to == std::get<scene::LineTo>(b).to;
    return std::holds_alternative<scene::Close>(a);
}

bool isSamePath(const std::shared_ptr<const Path>& a, const std::shared_ptr<const Path>& b) {
    return a == b || (a->size() <= fewCommands && std::ranges::equal(*a, *b, isSameCorner));
}

bool areSameStops(const std::vector<scene::GradientStop>& a, const std::vector<scene::GradientStop>& b) {
    return std::ranges::equal(a, b, [](const scene::GradientStop& s, const scene::GradientStop& t) {
        return s.offset == t.offset && s.color == t.color;
    });
}

/// The values of a paint but for its stops.
auto valuesOf(const scene::Color& p) { return std::tie(p); }
auto valuesOf(const scene::LinearGradient& p) { return std::tie(p.start, p.end, p.spread, p.transform); }
auto valuesOf(const scene::RadialGradient& p) {
    return std::tie(p.center, p.radius, p.focus, p.focalRadius, p.spread, p.transform);
}
auto valuesOf(const scene::Pattern& p) { return std::tie(p.min, p.max, p.content, p.transform); }
auto valuesOf(const scene::ImagePaint& p) { return std::tie(p.bitmap, p.filter, p.transform); }
auto valuesOf(const scene::Material& p) { return std::tie(p.name, p.glsl, p.fallback, p.transform); }

bool isSamePaint(const scene::Paint& a, const scene::Paint& b) {
    return a.index() == b.index() && std::visit(
                                         [&]<class Kind>(const Kind& p) {
                                             const auto& q = std::get<Kind>(b);
                                             if constexpr (requires { p.stops; })
                                                 if (!areSameStops(p.stops, q.stops))
                                                     return false;
                                             return valuesOf(p) == valuesOf(q);
                                         },
                                         a);
}

}  // namespace

bool isSame(const Item& a, const Item& b) {
    return std::tie(a.transform, a.geometry, a.opacity) == std::tie(b.transform, b.geometry, b.opacity) &&
           isSamePath(a.path, b.path) && isSamePaint(a.paint, b.paint);
}

bool isSame(const Select& a, const Select& b) {
    return std::tie(a.mask.transform, a.mask.geometry, a.inside, a.outside) ==
               std::tie(b.mask.transform, b.mask.geometry, b.inside, b.outside) &&
           isSamePath(a.mask.path, b.mask.path);
}

bool isSameBesideChildren(const Group& a, const Group& b) {
    return std::tie(a.opacity, a.blend, a.clip, a.mask, a.filter) ==
           std::tie(b.opacity, b.blend, b.clip, b.mask, b.filter);
}

bool isSame(const Node& a, const Node& b) {
    return a.value.index() == b.value.index() && std::visit(
                                                     [&]<class Kind>(const Kind& value) {
                                                         const auto& other = std::get<Kind>(b.value);
                                                         if constexpr (std::is_same_v<Kind, Group>)
                                                             return isSameBesideChildren(value, other) &&
                                                                    areSame(value.children, other.children);
                                                         else
                                                             return isSame(value, other);
                                                     },
                                                     a.value);
}

bool areSame(const NodeList& a, const NodeList& b) {
    return std::ranges::equal(a, b, [](const Node& one, const Node& other) { return isSame(one, other); });
}

}  // namespace vtm::compiler

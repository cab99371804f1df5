// Linear and radial gradients. Source: SVG 2 section 14.2.

#include <glm/geometric.hpp>

#include <algorithm>

#include "svg/convert/converter.hpp"

namespace vtm::svg {
namespace {

/// How close to the end circle the focal circle may come, as a share of its radius. On the circle the
/// cone of offsets opens to a half plane and a division by zero shows.
constexpr double focusLimit = 1 - 1e-5;

scene::Spread spreadOf(const TemplateChain& chain) {
    const std::string_view text = trim(inherited(chain, "spreadMethod"));
    return text == "reflect"  ? scene::Spread::Reflect
           : text == "repeat" ? scene::Spread::Repeat
                              : scene::Spread::Pad;
}

/// Reads a gradient's coordinates, in bounding box units or in user units.
struct Coordinates {
    const TemplateChain& chain;
    Tag tag;
    Viewport viewport;
    Units units;

    std::optional<double> find(std::string_view name, Axis axis) const {
        const auto length = parseLength(inherited(chain, name, tag), units);
        return length ? std::optional(resolve(*length, axis, viewport)) : std::nullopt;
    }
    double get(std::string_view name, Axis axis, double percent) const {
        return find(name, axis).value_or(resolve({percent, true}, axis, viewport));
    }
};

scene::Paint linear(const Coordinates& at, std::vector<scene::GradientStop> stops, scene::Spread spread,
                    const scene::Affine& transform) {
    const scene::Point start(at.get("x1", Axis::X, 0), at.get("y1", Axis::Y, 0));
    const scene::Point end(at.get("x2", Axis::X, 100), at.get("y2", Axis::Y, 0));
    if (start == end)
        return stops.back().color;
    return scene::LinearGradient{start, end, std::move(stops), spread, transform};
}

/// A focal circle outside the end circle is moved inside along the line of centres (SVG 1.1 section
/// 13.2.3): the scene knows no cones.
scene::Paint radial(const Coordinates& at, std::vector<scene::GradientStop> stops, scene::Spread spread,
                    const scene::Affine& transform) {
    const scene::Point center(at.get("cx", Axis::X, 50), at.get("cy", Axis::Y, 50));
    const double radius = at.get("r", Axis::Diagonal, 50),
                 focal = std::max(0.0, at.get("fr", Axis::Diagonal, 0));
    if (!(radius > 0) || focal >= radius)
        return stops.back().color;
    scene::Point focus(at.find("fx", Axis::X).value_or(center.x), at.find("fy", Axis::Y).value_or(center.y));
    const double distance = glm::distance(focus, center), maximum = (radius - focal) * focusLimit;
    if (distance > maximum)
        focus = center + (focus - center) * (maximum / distance);
    return scene::RadialGradient{center, radius, focus, focal, std::move(stops), spread, transform};
}

}  // namespace

/// Stops of the first gradient in the chain that has any.
const std::vector<scene::GradientStop>& Converter::gradientStops(const TemplateChain& chain) {
    static const std::vector<scene::GradientStop> nothing;
    for (const Element* gradient : chain) {
        limits::check();
        const auto [found, isNew] = stops_.try_emplace(gradient);
        if (isNew)
            found->second = stopsIn(*gradient);
        if (!found->second.empty())
            return found->second;
    }
    return nothing;
}

/// Offsets clamped and never decreasing.
std::vector<scene::GradientStop> Converter::stopsIn(const Element& gradient) {
    std::vector<scene::GradientStop> stops;
    float last = 0;
    for (const Element* child : gradient.children) {
        limits::check();
        if (child->tag != Tag::Stop)
            continue;
        const double offset = parseFraction(child->get("offset")).value_or(0);
        last = std::max(last, static_cast<float>(std::clamp(offset, 0.0, 1.0)));
        const Style& style = styleOf(*child);
        scene::Color color = resolveColor(style.stopColor, style);
        color.a *= static_cast<float>(style.stopOpacity);
        stops.push_back({last, color});
    }
    return stops;
}

Converter::ServerResult Converter::gradient(const Element& server, const Scope& scope, const Box& box) {
    const TemplateChain chain = templateChain(server);
    std::vector<scene::GradientStop> stops = gradientStops(chain);
    if (stops.empty())
        return Invalid{};
    if (stops.size() == 1)
        return scene::Paint(stops.front().color);
    const bool userSpace = trim(inherited(chain, "gradientUnits")) == "userSpaceOnUse";
    if (!userSpace && !(box.width() > 0 && box.height() > 0))
        return Invalid{};
    const Viewport viewport = userSpace ? scope.viewport : Viewport{1, 1};
    const Style& style = styleOf(server);
    scene::Affine transform = transformFrom(inherited(chain, "gradientTransform"), style, viewport);
    if (!userSpace)
        transform = scene::compose(unitSquareTo(box), transform);
    if (!scene::inverse(transform))
        return Nothing{};
    const Coordinates at{chain, server.tag, viewport, unitsFor(style)};
    const scene::Spread spread = spreadOf(chain);
    return server.tag == Tag::LinearGradient ? linear(at, std::move(stops), spread, transform)
                                             : radial(at, std::move(stops), spread, transform);
}

}  // namespace vtm::svg

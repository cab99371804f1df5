#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "svg/convert/converter.hpp"
#include "svg/css/color_spaces.hpp"

namespace vtm::svg {

// ---- Values of fill and stroke (SVG 2 section 13.2) ---------------------------------------------

scene::Paint mapPaint(scene::Paint paint, const scene::Affine& change) {
    std::visit(
        [&](auto& value) {
            if constexpr (requires { value.transform; })
                value.transform = scene::compose(change, value.transform);
        },
        paint);
    return paint;
}

std::optional<scene::Paint> Converter::paint(const PaintValue& value, const Element& element,
                                             const Scope& scope, const Box& box) {
    switch (value.kind) {
        case PaintKind::None:
            return std::nullopt;
        case PaintKind::Color:
            return value.color;
        case PaintKind::CurrentColor:
            return scope.style.color;
        case PaintKind::ContextFill:
            return contextPaint(true, scope);
        case PaintKind::ContextStroke:
            return contextPaint(false, scope);
        case PaintKind::Server:
            break;
    }
    ServerResult result = server(value.server, element, scope, box);
    if (auto* paint = std::get_if<scene::Paint>(&result))
        return std::move(*paint);
    if (std::holds_alternative<Nothing>(result) || !value.fallback)
        return std::nullopt;
    return paint({*value.fallback, value.color, {}, {}}, element, scope, box);
}

std::optional<scene::Paint> Converter::contextPaint(bool fill, const Scope& scope) {
    if (!scope.context)
        return std::nullopt;
    const Scope& outer = scope.context->scope;
    const PaintValue& value = fill ? outer.style.fill : outer.style.stroke;
    const Box box = value.kind == PaintKind::Server ? contextBox(*scope.context) : Box{};
    auto result = paint(value, scope.context->element, outer, box);
    const auto toUser = scene::inverse(scope.transform);
    if (!result || !toUser)
        return std::nullopt;
    return mapPaint(std::move(*result), scene::compose(*toUser, outer.transform));
}

/// The box of a use is that of its content, which a trial conversion finds.
const Box& Converter::contextBox(const ContextElement& context) {
    if (!context.box) {
        context.box = Box{};  // what the trial itself sees
        withoutOutlines([&] {
            context.box = boxAround(context.scope, [&] {
                Nodes unused;
                convertUsed(context.element, *tree_.byHref(*hrefOf(context.element)), context.scope, unused);
            });
        });
    }
    return *context.box;
}

Converter::ServerResult Converter::server(std::string_view href, const Element& element, const Scope& scope,
                                          const Box& box) {
    const Element* server = tree_.byHref(href);
    const Tag tag = server ? server->tag : Tag::Unknown;
    if (tag == Tag::LinearGradient || tag == Tag::RadialGradient)
        return gradient(*server, scope, box);
    if (tag == Tag::Pattern)
        return pattern(*server, scope, box);
    reporter_.warn(Kind::Reference, element, fmt::format("\"{}\" is not a paint server", href));
    return Invalid{};
}

std::string_view inherited(const TemplateChain& chain, std::string_view name, Tag tag) {
    for (const Element* element : chain)
        if (tag == Tag::Unknown || element->tag == tag)
            if (const auto value = element->find(name))
                return *value;
    return {};
}

std::string_view Converter::templateTransform(const TemplateChain& chain) {
    for (const Element* element : chain)
        if (const std::string_view transform = styleOf(*element).transform; !transform.empty())
            return transform;
    return {};
}

TemplateChain Converter::templateChain(const Element& server) {
    const bool isPattern = server.tag == Tag::Pattern;
    std::vector<const Element*> chain;
    std::unordered_set<const Element*> seen;
    for (const Element* next = &server; next;) {
        const bool fits = isPattern ? next->tag == Tag::Pattern
                                    : next->tag == Tag::LinearGradient || next->tag == Tag::RadialGradient;
        if (!fits || !seen.insert(next).second) {
            reporter_.warn(
                Kind::Reference, server,
                fits ? "refers to itself, directly or indirectly" : "refers to an element of another kind");
            break;
        }
        limits::check();
        chain.push_back(next);
        const auto href = hrefOf(*next);
        next = href ? tree_.byHref(*href) : nullptr;
        if (href && !next)
            reporter_.warn(Kind::Reference, server,
                           fmt::format("refers to \"{}\", which is not here", *href));
    }
    return chain;
}

// ---- Linear and radial gradients (SVG 2 section 14.2) -------------------------------------------

namespace {

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

/// A focal circle outside the end circle makes a cone (SVG 2 section 14.2.3), where SVG 1.1 moved it inside.
scene::Paint radial(const Coordinates& at, std::vector<scene::GradientStop> stops, scene::Spread spread,
                    const scene::Affine& transform) {
    const scene::Point center(at.get("cx", Axis::X, 50), at.get("cy", Axis::Y, 50));
    const double radius = at.get("r", Axis::Diagonal, 50),
                 focal = std::max(0.0, at.get("fr", Axis::Diagonal, 0));
    const scene::Point focus(at.find("fx", Axis::X).value_or(center.x),
                             at.find("fy", Axis::Y).value_or(center.y));
    if (!(radius > 0) || (focus == center && focal == radius))
        return stops.back().color;
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

namespace {

/// Between two stops what is linear in light is nearly linear in sRGB once it is cut small enough.
void addInLinearLight(const scene::GradientStop& from, const scene::GradientStop& to, int depth,
                      std::vector<scene::GradientStop>& stops) {
    static const ColorSpace &srgb = *findColorSpace("srgb"), &linear = *findColorSpace("srgb-linear");
    constexpr double tolerance = 0.25 / 255;
    const Vec3 a(from.color.r, from.color.g, from.color.b), b(to.color.r, to.color.g, to.color.b);
    const auto light = [](Vec3 color) { return linear.fromXyz(srgb.toXyz(color)); };
    // Rounding may leave [0, 1].
    const Vec3 middle = glm::clamp(srgb.fromXyz(linear.toXyz((light(a) + light(b)) / 2.0)), 0.0, 1.0);
    const Vec3 error = glm::abs(middle - (a + b) / 2.0);
    if (depth > 0 && std::max({error.x, error.y, error.z}) > tolerance) {
        const scene::GradientStop half{
            (from.offset + to.offset) / 2,
            {float(middle.x), float(middle.y), float(middle.z), (from.color.a + to.color.a) / 2}};
        addInLinearLight(from, half, depth - 1, stops);
        addInLinearLight(half, to, depth - 1, stops);
        return;
    }
    stops.push_back(to);
}

std::vector<scene::GradientStop> inLinearLight(const std::vector<scene::GradientStop>& stops) {
    constexpr int maxDepth = 12;  // sRGB is steep at black: most parts are far larger
    std::vector<scene::GradientStop> result{stops.front()};
    for (std::size_t i = 1; i < stops.size(); ++i) {
        limits::check();
        addInLinearLight(stops[i - 1], stops[i], maxDepth, result);
    }
    return result;
}

}  // namespace

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
    scene::Affine transform = transformFrom(templateTransform(chain), style, viewport);
    if (!userSpace)
        transform = scene::compose(unitSquareTo(box), transform);
    if (!scene::inverse(transform))
        return Nothing{};
    if (style.linearColors)
        stops = inLinearLight(stops);
    const Coordinates at{chain, server.tag, viewport, unitsFor(style)};
    const scene::Spread spread = spreadOf(chain);
    return server.tag == Tag::LinearGradient ? linear(at, std::move(stops), spread, transform)
                                             : radial(at, std::move(stops), spread, transform);
}

// ---- Patterns (SVG 2 section 14.3) --------------------------------------------------------------
// The scene's pattern space is the content's own: viewBox and content units go into the paint's transform, so
// that all users of a pattern share one content.

namespace {

/// The first pattern in the chain that has elements in it, null if none has.
const Element* contentOwner(const TemplateChain& chain) {
    const auto hasElements = [](const Element* pattern) {
        return std::any_of(pattern->children.begin(), pattern->children.end(),
                           [](const Element* child) { return child->tag != Tag::CharacterData; });
    };
    const auto found = std::find_if(chain.begin(), chain.end(), hasElements);
    return found == chain.end() ? nullptr : *found;
}

/// The tile in the pattern's coordinate system.
Rect tileOf(const TemplateChain& chain, bool boxUnits, const Viewport& viewport, const Units& units,
            const Box& box) {
    const Viewport reference = boxUnits ? Viewport{1, 1} : viewport;
    const auto get = [&](std::string_view name, Axis axis) {
        const auto length = parseLength(inherited(chain, name), units);
        return length ? resolve(*length, axis, reference) : 0;
    };
    Rect tile{get("x", Axis::X), get("y", Axis::Y), get("width", Axis::X), get("height", Axis::Y)};
    if (boxUnits)
        tile = {box.min.x + tile.x * box.width(), box.min.y + tile.y * box.height(), tile.width * box.width(),
                tile.height * box.height()};
    return tile;
}

}  // namespace

/// One that paints nothing, as without tiles or content, is invalid: browsers and the W3C's test
/// pservers-pattern-03-f take the fallback then.
Converter::ServerResult Converter::pattern(const Element& server, const Scope& scope, const Box& box) {
    const TemplateChain chain = templateChain(server);
    const Element* owner = contentOwner(chain);
    if (!owner)
        return Invalid{};
    const auto viewBox = parseViewBox(inherited(chain, "viewBox"));
    const bool boxUnits = trim(inherited(chain, "patternUnits")) != "userSpaceOnUse";
    const bool boxContent = !viewBox && trim(inherited(chain, "patternContentUnits")) == "objectBoundingBox";
    if ((boxUnits || boxContent) && !(box.width() > 0 && box.height() > 0))
        return Invalid{};
    const Style& style = styleOf(server);
    const Rect tile = tileOf(chain, boxUnits, scope.viewport, unitsFor(style), box);
    if (!(tile.width > 0 && tile.height > 0) || isEmptyViewBox(inherited(chain, "viewBox")))
        return Invalid{};
    // Without a viewBox the content's origin is the tile's corner.
    const scene::Affine scale = boxContent ? scene::scaling(box.width(), box.height()) : scene::identity;
    const scene::Affine toTile =
        viewBox ? scene::fittedMap(*viewBox, parseAspectRatio(inherited(chain, "preserveAspectRatio")), tile)
                : scene::compose(scene::translation(tile.x, tile.y), scale);
    const scene::Affine transform =
        scene::compose(transformFrom(templateTransform(chain), style, scope.viewport), toTile);
    const auto toContent = scene::inverse(toTile);
    if (!scene::inverse(transform) || !toContent)
        return Invalid{};
    const Viewport inner = viewBox ? Viewport{viewBox->width, viewBox->height} : rootSize_;
    const Box period = geometry::mapped(toBox(tile), *toContent);
    if (!(period.width() > 0 && period.height() > 0) || !isWithinReach(period))
        return Invalid{};
    auto content = patternContent(*owner, inner);
    if (!content)
        return Invalid{};
    return scene::Paint(scene::Pattern{period.min, period.max, std::move(content), transform});
}

/// Sharing saves the conversion, but whoever walks the scene meets the content each time: every use
/// spends what the first one did.
std::shared_ptr<const scene::Group> Converter::patternContent(const Element& owner,
                                                              const Viewport& viewport) {
    if (const auto found = patterns_.find(&owner); found != patterns_.end())
        return spend(found->second.visits) ? found->second.group : nullptr;
    const Expansion expansion(active_, owner);
    if (!expansion || !spend()) {
        reporter_.warn(Kind::Reference, owner, "refers to itself, directly or indirectly");
        return nullptr;
    }
    const Level level(*this, owner);
    if (!level)
        return nullptr;
    auto content = std::make_shared<scene::Group>();
    Scope scope;
    scope.style = styleOf(owner);
    scope.viewport = viewport;
    scope.depth = static_cast<int>(active_.size());
    const std::size_t before = budget_.visits;
    withoutOutlines([&] { convertChildren(owner, scope, content->children); });
    patterns_.emplace(&owner, PatternContent{content, 1 + before - budget_.visits});
    return content;
}

}  // namespace vtm::svg

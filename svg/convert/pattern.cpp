// Patterns. Source: SVG 2 section 14.3. The scene's pattern space is the content's own: viewBox and
// content units go into the paint's transform, so that all users of a pattern share one content.

#include <algorithm>
#include <cmath>

#include "svg/convert/converter.hpp"

namespace vtm::svg {
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

Converter::ServerResult Converter::pattern(const Element& server, const Scope& scope, const Box& box) {
    const TemplateChain chain = templateChain(server);
    const Element* owner = contentOwner(chain);
    if (!owner)
        return Nothing{};
    const auto viewBox = parseViewBox(inherited(chain, "viewBox"));
    const bool boxUnits = trim(inherited(chain, "patternUnits")) != "userSpaceOnUse";
    const bool boxContent = !viewBox && trim(inherited(chain, "patternContentUnits")) == "objectBoundingBox";
    if ((boxUnits || boxContent) && !(box.width() > 0 && box.height() > 0))
        return Invalid{};
    const Style& style = styleOf(server);
    const Rect tile = tileOf(chain, boxUnits, scope.viewport, unitsFor(style), box);
    if (!(tile.width > 0 && tile.height > 0) || isEmptyViewBox(inherited(chain, "viewBox")))
        return Nothing{};
    // Without a viewBox the content's origin is the tile's corner.
    const scene::Affine scale = boxContent ? scene::scaling(box.width(), box.height()) : scene::identity;
    const scene::Affine toTile =
        viewBox ? scene::fittedMap(*viewBox, parseAspectRatio(inherited(chain, "preserveAspectRatio")), tile)
                : scene::compose(scene::translation(tile.x, tile.y), scale);
    const scene::Affine transform =
        scene::compose(transformFrom(inherited(chain, "patternTransform"), style, scope.viewport), toTile);
    const auto toContent = scene::inverse(toTile);
    if (!scene::inverse(transform) || !toContent)
        return Nothing{};
    const Viewport inner = viewBox ? Viewport{viewBox->width, viewBox->height} : rootSize_;
    const Box period = geometry::mapped(toBox(tile), *toContent);
    if (!(period.width() > 0 && period.height() > 0) || !isWithinReach(period))
        return Nothing{};
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

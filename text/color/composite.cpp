#include "text/color/composite.hpp"

#include <optional>
#include <utility>

namespace vtm::text {
namespace {

using scene::BlendMode;
using scene::NodeList;

scene::Group groupOf(NodeList nodes) {
    scene::Group group;
    group.children = std::move(nodes);
    return group;
}

NodeList one(scene::Group group) { return NodeList{{scene::Node{std::move(group)}}}; }

NodeList joined(NodeList below, NodeList above) {
    for (scene::Node& node : above)
        below.push_back(std::move(node));
    return below;
}

/// Multiplied by the alpha of `by`.
NodeList masked(NodeList nodes, const NodeList& by, scene::MaskKind kind = scene::MaskKind::Alpha) {
    scene::Mask mask;
    mask.content = std::make_shared<const scene::Group>(groupOf(by));
    mask.kind = kind;
    scene::Group group = groupOf(std::move(nodes));
    group.mask = std::make_shared<const scene::Mask>(std::move(mask));
    return one(std::move(group));
}

scene::Item colored(scene::Item item, const scene::Color& color) {
    item.paint = color;
    return item;
}

/// Multiplied by 1 - alpha of `by`: the luminance of black with that alpha over white.
NodeList maskedOutside(NodeList nodes, const NodeList& by, const scene::Item& everywhere) {
    const scene::Color black{0, 0, 0, 1}, white{1, 1, 1, 1};
    NodeList content{{scene::Node{colored(everywhere, white)}}};
    content = joined(std::move(content), masked(NodeList{{scene::Node{colored(everywhere, black)}}}, by));
    return masked(std::move(nodes), content, scene::MaskKind::Luminance);
}

NodeList blended(NodeList source, NodeList backdrop, BlendMode mode) {
    scene::Group above = groupOf(std::move(source));
    above.blend = mode;
    return one(groupOf(joined(std::move(backdrop), one(std::move(above)))));
}

/// The parts of Porter and Duff's operators; their sums have no alpha above 1.
class Operands {
public:
    Operands(NodeList source, NodeList backdrop, const scene::Item& everywhere)
        : source_(std::move(source)), backdrop_(std::move(backdrop)), everywhere_(everywhere) {}

    NodeList sourceIn() const { return masked(source_, backdrop_); }
    NodeList backdropIn() const { return masked(backdrop_, source_); }
    NodeList sourceOut() const { return maskedOutside(source_, backdrop_, everywhere_); }
    NodeList backdropOut() const { return maskedOutside(backdrop_, source_, everywhere_); }

private:
    NodeList source_, backdrop_;
    const scene::Item& everywhere_;
};

std::optional<BlendMode> blendMode(FT_Composite_Mode mode) {
    switch (mode) {
        case FT_COLR_COMPOSITE_PLUS:
            return BlendMode::PlusLighter;
        case FT_COLR_COMPOSITE_SCREEN:
            return BlendMode::Screen;
        case FT_COLR_COMPOSITE_OVERLAY:
            return BlendMode::Overlay;
        case FT_COLR_COMPOSITE_DARKEN:
            return BlendMode::Darken;
        case FT_COLR_COMPOSITE_LIGHTEN:
            return BlendMode::Lighten;
        case FT_COLR_COMPOSITE_COLOR_DODGE:
            return BlendMode::ColorDodge;
        case FT_COLR_COMPOSITE_COLOR_BURN:
            return BlendMode::ColorBurn;
        case FT_COLR_COMPOSITE_HARD_LIGHT:
            return BlendMode::HardLight;
        case FT_COLR_COMPOSITE_SOFT_LIGHT:
            return BlendMode::SoftLight;
        case FT_COLR_COMPOSITE_DIFFERENCE:
            return BlendMode::Difference;
        case FT_COLR_COMPOSITE_EXCLUSION:
            return BlendMode::Exclusion;
        case FT_COLR_COMPOSITE_MULTIPLY:
            return BlendMode::Multiply;
        case FT_COLR_COMPOSITE_HSL_HUE:
            return BlendMode::Hue;
        case FT_COLR_COMPOSITE_HSL_SATURATION:
            return BlendMode::Saturation;
        case FT_COLR_COMPOSITE_HSL_COLOR:
            return BlendMode::Color;
        case FT_COLR_COMPOSITE_HSL_LUMINOSITY:
            return BlendMode::Luminosity;
        default:
            return std::nullopt;
    }
}

NodeList sum(NodeList a, NodeList b) { return blended(std::move(a), std::move(b), BlendMode::PlusLighter); }

}  // namespace

NodeList composited(FT_Composite_Mode mode, NodeList source, NodeList backdrop,
                    const scene::Item& everywhere) {
    if (const auto blend = blendMode(mode))
        return blended(std::move(source), std::move(backdrop), *blend);
    const Operands operands(source, backdrop, everywhere);
    switch (mode) {
        case FT_COLR_COMPOSITE_SRC:
            return source;
        case FT_COLR_COMPOSITE_DEST:
            return backdrop;
        case FT_COLR_COMPOSITE_SRC_OVER:
            return one(groupOf(joined(std::move(backdrop), std::move(source))));
        case FT_COLR_COMPOSITE_DEST_OVER:
            return one(groupOf(joined(std::move(source), std::move(backdrop))));
        case FT_COLR_COMPOSITE_SRC_IN:
            return operands.sourceIn();
        case FT_COLR_COMPOSITE_DEST_IN:
            return operands.backdropIn();
        case FT_COLR_COMPOSITE_SRC_OUT:
            return operands.sourceOut();
        case FT_COLR_COMPOSITE_DEST_OUT:
            return operands.backdropOut();
        case FT_COLR_COMPOSITE_SRC_ATOP:
            return sum(operands.sourceIn(), operands.backdropOut());
        case FT_COLR_COMPOSITE_DEST_ATOP:
            return sum(operands.backdropIn(), operands.sourceOut());
        case FT_COLR_COMPOSITE_XOR:
            return sum(operands.sourceOut(), operands.backdropOut());
        default:
            return {};  // CLEAR, and what fonts must not have
    }
}

}  // namespace vtm::text

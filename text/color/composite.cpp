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

std::optional<BlendMode> blendMode(CompositeMode mode) {
    switch (mode) {
        case CompositeMode::Plus:
            return BlendMode::PlusLighter;
        case CompositeMode::Screen:
            return BlendMode::Screen;
        case CompositeMode::Overlay:
            return BlendMode::Overlay;
        case CompositeMode::Darken:
            return BlendMode::Darken;
        case CompositeMode::Lighten:
            return BlendMode::Lighten;
        case CompositeMode::ColorDodge:
            return BlendMode::ColorDodge;
        case CompositeMode::ColorBurn:
            return BlendMode::ColorBurn;
        case CompositeMode::HardLight:
            return BlendMode::HardLight;
        case CompositeMode::SoftLight:
            return BlendMode::SoftLight;
        case CompositeMode::Difference:
            return BlendMode::Difference;
        case CompositeMode::Exclusion:
            return BlendMode::Exclusion;
        case CompositeMode::Multiply:
            return BlendMode::Multiply;
        case CompositeMode::Hue:
            return BlendMode::Hue;
        case CompositeMode::Saturation:
            return BlendMode::Saturation;
        case CompositeMode::Color:
            return BlendMode::Color;
        case CompositeMode::Luminosity:
            return BlendMode::Luminosity;
        default:
            return std::nullopt;
    }
}

NodeList sum(NodeList a, NodeList b) { return blended(std::move(a), std::move(b), BlendMode::PlusLighter); }

}  // namespace

NodeList composited(CompositeMode mode, NodeList source, NodeList backdrop, const scene::Item& everywhere) {
    if (const auto blend = blendMode(mode))
        return blended(std::move(source), std::move(backdrop), *blend);
    const Operands operands(source, backdrop, everywhere);
    switch (mode) {
        case CompositeMode::Source:
            return source;
        case CompositeMode::Backdrop:
            return backdrop;
        case CompositeMode::SourceOver:
            return one(groupOf(joined(std::move(backdrop), std::move(source))));
        case CompositeMode::BackdropOver:
            return one(groupOf(joined(std::move(source), std::move(backdrop))));
        case CompositeMode::SourceIn:
            return operands.sourceIn();
        case CompositeMode::BackdropIn:
            return operands.backdropIn();
        case CompositeMode::SourceOut:
            return operands.sourceOut();
        case CompositeMode::BackdropOut:
            return operands.backdropOut();
        case CompositeMode::SourceAtop:
            return sum(operands.sourceIn(), operands.backdropOut());
        case CompositeMode::BackdropAtop:
            return sum(operands.backdropIn(), operands.sourceOut());
        case CompositeMode::Xor:
            return sum(operands.sourceOut(), operands.backdropOut());
        default:
            return {};  // Clear, and what fonts must not have
    }
}

}  // namespace vtm::text

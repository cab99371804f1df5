#include "compiler/direct/layer_cover.hpp"

#include <algorithm>
#include <cmath>

#include "asset/records.hpp"
#include "compiler/paint/composite.hpp"

namespace vtm::compiler {
namespace {

/// The circles of a radial gradient fill the plane if the smallest one reaches no further, in radii of the
/// largest.
constexpr float fillsPlane = 0.9f;

/// The least alpha of a paint, or less.
float leastAlpha(const LoweredScene& picture, const Source& source) {
    if (source.opaque)
        return 1;
    if (source.op == asset::Op::Solid)
        return source.color[3];
    if (source.op != asset::Op::Linear && source.op != asset::Op::Radial)
        return 0;
    const auto gradient = asset::recordAt<asset::Gradient>(picture.data, source.data);
    // Circles that do not lie within each other leave parts of the plane empty.
    if (source.op == asset::Op::Radial && gradient.fr + std::hypot(gradient.fx, gradient.fy) > fillsPlane)
        return 0;
    const std::size_t first = source.data + asset::GradientView::headTexels;
    std::uint16_t least = 0xFFFF;
    for (std::size_t stop = 0; stop < gradient.stopCount; ++stop)
        least = std::min(least, asset::recordAt<asset::GradientStop>(picture.data, first + stop).rgba[3]);
    return float(least) / 0xFFFF;
}

}  // namespace

std::vector<LayerCover> layerCovers(const LoweredScene& picture) {
    const std::vector<std::uint8_t> isClipped = clippedGroups(picture);
    struct Around {
        bool isPlain, isLaidOver;
        float opacity;
        std::uint32_t translucent;  ///< the outermost
    };
    std::vector<Around> groups;
    for (std::uint32_t g = 0; g < picture.groups.size(); ++g) {  // parents come first
        const LoweredGroup& group = picture.groups[g];
        const Around outer = group.parent == noIndex ? Around{true, true, 1, noIndex} : groups[group.parent];
        const bool isPlain = outer.isPlain && group.role == GroupRole::Plain;
        groups.push_back({isPlain,
                          outer.isLaidOver && isPlain && group.blend == scene::BlendMode::Normal &&
                              group.mask == noIndex && isClipped[g] == 0,
                          outer.opacity * group.opacity,
                          outer.translucent == noIndex && group.opacity < 1 ? g : outer.translucent});
    }
    std::vector<LayerCover> covers(picture.layers.size());
    for (const LoweredItem& item : picture.items) {
        const Around& around = groups[item.group];
        LayerCover& cover = covers[item.layer];
        cover.mayBeHidden = around.isPlain;
        cover.group = around.translucent;
        if (around.isLaidOver)
            cover.alpha = leastAlpha(picture, picture.sources[item.source]) * item.opacity * around.opacity;
    }
    return covers;
}

}  // namespace vtm::compiler

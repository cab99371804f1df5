#include "compiler/direct/solid_layers.hpp"

namespace vtm::compiler {

SolidLayers::SolidLayers(const LoweredScene& picture)
    : layers(picture.layers.size()), groups(picture.groups.size()) {
    std::vector<std::size_t> layersIn(groups.size());
    for (const LoweredItem& item : picture.items)
        ++layersIn[item.group];
    for (std::size_t g = groups.size(); g-- > 0;)  // parents come first
        if (picture.groups[g].parent != noIndex)
            layersIn[picture.groups[g].parent] += layersIn[g];
    struct Around {
        std::uint32_t group = noIndex;  ///< the innermost that is composited
        float opacity = 1;              ///< of groups within it
    };
    std::vector<Around> around(groups.size());
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        const LoweredGroup& group = picture.groups[g];
        const Around outer = group.parent == noIndex ? Around{} : around[group.parent];
        groups[g] = {group.opacity, outer.group};
        const bool isComposited = group.opacity < 1 && layersIn[g] > 1;
        around[g] = isComposited ? Around{g, 1} : Around{outer.group, outer.opacity * group.opacity};
    }
    for (const LoweredItem& item : picture.items) {
        const auto& c = picture.sources[item.source].color;
        layers[item.layer] = {item.opacity * around[item.group].opacity * glm::vec4(c[0], c[1], c[2], c[3]),
                              around[item.group].group,
                              picture.layers[item.layer].rule == scene::FillRule::EvenOdd};
    }
}

}  // namespace vtm::compiler

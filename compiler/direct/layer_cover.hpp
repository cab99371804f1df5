/// \file
/// How much of what lies below a layer shows through it.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// What is laid under paints that let no more than this through is left out: less than a quarter of a step
/// of 8 bits.
inline constexpr float unseen = 0x1p-10f;

/// By layer, for all of its inside.
struct LayerCover {
    float alpha = 0;                ///< at least
    std::uint32_t group = noIndex;  ///< the outermost translucent one: its layers cover together
    bool mayBeHidden = false;       ///< by layers above that cover
};

/// What comes through layers, taken from the top.
class LightBelow {
public:
    float light() const { return light_; }
    void add(const LayerCover& cover) {
        // Of a group's layers only the topmost counts.
        if (cover.group == noIndex || cover.group != group_)
            light_ *= 1 - cover.alpha;
        group_ = cover.alpha > 0 ? cover.group : group_;
    }

private:
    float light_ = 1;
    std::uint32_t group_ = noIndex;
};

/// A layer covers if it is laid over what lies below it, unclipped; all but clips and masks may be hidden.
std::vector<LayerCover> layerCovers(const LoweredScene& picture);

}  // namespace vtm::compiler

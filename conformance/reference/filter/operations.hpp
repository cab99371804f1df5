/// \file
/// The operations of filters, from the formulas of Filter Effects Module Level 1 alone.
#pragma once

#include <vector>

#include <vtm/scene/filter.hpp>
#include "conformance/reference/filter/pixels.hpp"

namespace vtm::reference {

/// What an operation reads: its inputs, in its colour space, and their subregions; its own if it has none.
struct Reading {
    const std::vector<Pixels>& inputs;
    const std::vector<Rectangle>& regions;
    Frame frame;
    bool linear;
};

/// `blank` has the place of the result.
Pixels operate(const scene::BlendFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::ColorMatrixFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::ComponentTransferFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::CompositeFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::ConvolveMatrixFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::LightingFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::DisplacementMapFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::DropShadowFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::FloodFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::GaussianBlurFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::MergeFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::MorphologyFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::OffsetFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::TileFilter& f, const Reading& in, Pixels blank);
Pixels operate(const scene::TurbulenceFilter& f, const Reading& in, Pixels blank);

}  // namespace vtm::reference

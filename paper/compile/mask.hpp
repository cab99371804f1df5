/// \file
/// Paper mode: an item's shape to its mask.
#pragma once

#include <variant>

#include "paper/compile.hpp"
#include "paper/compile/outline.hpp"
#include "paper/model.hpp"

namespace vtm::paper {

struct MaskResult {
    Mask mask;
    std::size_t approximated = 0;  ///< cells of the last level that need more than a strict cell can say
    bool coversPicture = false;    ///< all of it is inside, whatever the mask says beyond its border
};

struct MaskOptions {
    Point pictureSize;
    double tolerance;  ///< picture units
    unsigned maxDepth, mipLog2;
};

/// An empty mask where nothing of the shape is in the picture. Throws compiler::LimitError.
MaskResult makeMask(const scene::Path& path, const scene::Affine& toPicture,
                    const std::variant<scene::FillRule, scene::StrokeStyle>& geometry,
                    const MaskOptions& options);

}  // namespace vtm::paper

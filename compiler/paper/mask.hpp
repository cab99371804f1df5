/// \file
/// Paper mode: an item's shape to its mask.
#pragma once

#include <variant>

#include "asset/paper.hpp"
#include "compiler/paper.hpp"
#include "compiler/paper/outline.hpp"

namespace vtm::compiler::paper {

struct MaskResult {
    asset::PaperMask mask;
    std::size_t approximated = 0;  ///< cells of the last level that need more than a strict cell can say
};

struct MaskOptions {
    Point pictureSize;
    double tolerance;  ///< picture units
    unsigned maxDepth, mipLog2;
};

/// An empty mask where nothing of the shape is in the picture. Throws LimitError.
MaskResult makeMask(const scene::Path& path, const scene::Affine& toPicture,
                    const std::variant<scene::FillRule, scene::StrokeStyle>& geometry,
                    const MaskOptions& options);

}  // namespace vtm::compiler::paper

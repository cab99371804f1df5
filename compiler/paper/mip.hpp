/// \file
/// Paper mode: the mip of the classification function.
#pragma once

#include "asset/paper.hpp"
#include "compiler/paper/outline.hpp"

namespace vtm::compiler::paper {

/// Shares inside: exact along x on eight lines a texel, mean over y; coarser levels are means of four.
asset::PaperMip makeMip(const Outline& outline, unsigned sizeLog2);

}  // namespace vtm::compiler::paper

/// \file
/// Paper mode: the mip of the classification function.
#pragma once

#include "paper/compile/outline.hpp"
#include "paper/model.hpp"

namespace vtm::paper {

/// Shares inside: exact along x on eight lines a texel, mean over y; coarser levels are means of four.
Mip makeMip(const Outline& outline, unsigned sizeLog2);

}  // namespace vtm::paper

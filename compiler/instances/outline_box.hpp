/// \file
/// Around a layer's outline before the picture's border cuts it.
#pragma once

#include "compiler/lower/lower.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {

/// In the picture's space. A stroke's has room for all mitres that its style allows.
geometry::Box outlineBox(const LayerOrigin& origin);

}  // namespace vtm::compiler

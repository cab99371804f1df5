/// \file
/// Random paints.
#pragma once

#include <vtm/scene/paint.hpp>
#include "conformance/generate/src/random.hpp"

namespace vtm::generate {

/// A colour, opaque or not, or a gradient without sharp edges over about [0, side]².
scene::Paint randomPaint(Random& random, double side);

}  // namespace vtm::generate

/// \file
/// Random paths, each of a kind that is hard on some stage.
#pragma once

#include "conformance/generate/src/random.hpp"

namespace vtm::generate {

/// Coordinates are about [0, side]². `before`: the last path made, for outlines that nearly coincide with it.
scene::Path randomOutline(Random& random, double side, const scene::Path& before);

}  // namespace vtm::generate

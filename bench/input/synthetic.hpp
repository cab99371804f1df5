/// \file
/// Scenes of any number of curves.
#pragma once

#include <cstddef>

#include <vtm/scene/scene.hpp>

namespace vtm::bench {

/// Blobs of four cubics each, `curves` in all (rounded up to a blob), strewn evenly over the unit square,
/// their size falling with the root of their number: each meets about as many others whatever the number. The
/// same on every machine.
scene::Scene syntheticScene(std::size_t curves);

}  // namespace vtm::bench

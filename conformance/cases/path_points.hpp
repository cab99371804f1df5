/// \file
/// Points of a path, command by command.
#pragma once

#include <vtm/scene/path.hpp>

namespace vtm::cases {

/// The point at t in [0, 1] of a line, curve or arc that goes on from `from`; `from` itself for other
/// commands.
scene::Point interpolate(scene::Point from, const scene::Command& command, double t);
/// Its derivative by t.
scene::Point derivative(scene::Point from, const scene::Command& command, double t);

}  // namespace vtm::cases

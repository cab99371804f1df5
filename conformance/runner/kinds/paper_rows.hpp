/// \file
/// The rows of the paper that are more than a picture: what they promise, tried on a scene.
#pragma once

#include <vtm/scene/scene.hpp>
#include "conformance/runner/suite/case.hpp"

namespace vtm::conformance {

/// By the row's number; null where the row is a picture and nothing else. Throws what the modules throw.
using RowCheck = Outcome (*)(const scene::Scene& scene);
RowCheck checkOfRow(int row);

}  // namespace vtm::conformance

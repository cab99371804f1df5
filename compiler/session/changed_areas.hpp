/// \file
/// Two scenes in; out comes where the second may look different from the first, filters included.
#pragma once

#include <vector>

#include <vtm/asset/difference.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::compiler {

/// Of pictures of one size: nothing looks different outside by more than 1/1000 of a colour. Where filters
/// resample, the pixels around an area may.
std::vector<asset::Area> changedAreas(const scene::Scene& before, const scene::Scene& after);

}  // namespace vtm::compiler

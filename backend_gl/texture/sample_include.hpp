/// \file
/// The include's parts.
#pragma once

#include <span>
#include <string>

#include "backend_gl/core/features.hpp"

namespace vtm::gl {

/// The include for paint programs with these features, and these materials.
std::string sampleText(Features features, std::span<const asset::Material> materials);

/// What a material is known by among those of all assets: a hash of its name and text.
std::uint32_t materialKey(const asset::Material& material);

}  // namespace vtm::gl

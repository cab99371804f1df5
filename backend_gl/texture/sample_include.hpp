/// \file
/// The include's parts.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "backend_gl/core/features.hpp"

namespace vtm::gl {

/// The same text with `vtm_` before the name of every function, structure and constant that it declares, and
/// `VTM_` before every macro that it defines; names that begin so already stay. Comments and blank lines go,
/// and so do constants that are used nowhere. Members of structures keep their names, so these must be
/// others.
std::string prefixed(std::string_view glsl);

/// The include for paint programs with these features, maps placed in each other so many levels deep, and
/// these materials.
std::string sampleText(Features features, unsigned innerMaps, std::span<const asset::Material> materials);

/// How many levels of placed maps an asset has; 0 without instances.
unsigned innerMapsOf(const asset::AssetView& asset);
/// What an asset asks of the include, a bit each: its features, then one for each level of placed maps.
std::uint32_t samplingFlags(Features features, unsigned innerMaps);

/// What a material is known by among those of all assets: a hash of its name and text.
std::uint32_t materialKey(const asset::Material& material);

}  // namespace vtm::gl

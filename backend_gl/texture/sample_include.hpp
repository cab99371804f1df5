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

/// What the include draws besides single maps.
struct SampledKinds {
    unsigned innerMaps = 0;  ///< how many levels deep maps are placed in each other
    bool pages = false;      ///< pages of text
};

/// The include for paint programs with these features, such pictures, and these materials.
std::string sampleText(Features features, SampledKinds kinds, std::span<const asset::Material> materials);

/// The include for these assets, and for pages of text if wanted: sampleInclude().
std::string includeFor(std::span<const asset::AssetView> assets, bool pages);

/// How many levels of placed maps an asset has; 0 without instances.
unsigned innerMapsOf(const asset::AssetView& asset);
/// What an asset asks of the include, a bit each: its features, then one for each level of placed maps, then
/// one for pages.
std::uint32_t samplingFlags(Features features, SampledKinds kinds);

/// What a material is known by among those of all assets: a hash of its name and text.
std::uint32_t materialKey(const asset::Material& material);

}  // namespace vtm::gl

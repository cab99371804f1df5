/// \file
/// A scene's filter in, the asset's records of it out.
#pragma once

#include <cstdint>

#include <vtm/asset/asset.hpp>
#include <vtm/scene/filter.hpp>

namespace vtm::compiler {

/// Appends the filter and returns its index. `toPicture`: from the scene. The pictures of PictureFilters are
/// numbered from 1, in their order.
std::uint32_t appendFilter(const scene::Filter& filter, const scene::Affine& toPicture, asset::Asset& asset);

}  // namespace vtm::compiler

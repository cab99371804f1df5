/// \file
/// Filters in the reference: the pictures that a filter reads in, its result out.
#pragma once

#include <functional>
#include <memory>

#include <vtm/scene/filter.hpp>
#include "conformance/reference/filter/pixels.hpp"

namespace vtm::reference {

/// Draws a group, sRGB-encoded, on the raster: `toPixels` maps the scene to pixels.
using DrawPicture =
    std::function<Pixels(const scene::Group& group, const scene::Affine& toPixels, const Pixels& place)>;

/// The result on the pixels of `place`, which `toPixels` maps the scene to, sRGB-encoded. `source`: what is
/// filtered. `wholePixels`: regions and offsets are rounded to pixels, as in compat mode.
Pixels filtered(const scene::Filter& filter, const scene::Group& source, const scene::Affine& toPixels,
                const Pixels& place, bool wholePixels, const DrawPicture& draw);

}  // namespace vtm::reference

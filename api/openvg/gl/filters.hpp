/// \file
/// Filters of images in textures (specification section 12).
#pragma once

#include "api/openvg/gl/device.hpp"
#include "api/openvg/image/image_filter.hpp"
#include "api/openvg/state/objects.hpp"

namespace vtm::openvg::gl {

/// The lower left parts of both images that have the size of the smaller one. False: it is to be done in
/// memory, because floats are not exact enough, too many texels would be read, or there is no room.
bool filterImage(Device& device, Image& to, const Image& from, const ImageFilter& filter);

}  // namespace vtm::openvg::gl

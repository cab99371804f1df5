/// \file
/// Pixels in a texture (class StoredPixels), and masks.
#pragma once

#include "api/openvg/gl/device.hpp"
#include "api/openvg/image/stored_pixels.hpp"
#include "api/openvg/state/objects.hpp"

namespace vtm::openvg::gl {

/// In a texture of a context that shares with the device's, which is the device's from now on.
std::unique_ptr<PixelCopy> copyIn(Device& device, GLenum format, GLuint texture, int width, int height);

/// Up to date, to be read or to be drawn into. Null where there is no room for it, or
/// where others have the pixels in a place of their own.
TexturePointer readTexture(Device& device, const StoredPixels& pixels);
TexturePointer writeTexture(Device& device, StoredPixels& pixels);

/// A part of pixels, from their texture or into it; `to` and `from` have the part's size and their format.
void readPart(Device& device, const StoredPixels& pixels, const Rectangle& part, Pixels& to);
void writePart(Device& device, StoredPixels& pixels, const Rectangle& part, const Pixels& from);

TexturePointer maskTexture(Device& device, const MaskValues& mask);

}  // namespace vtm::openvg::gl

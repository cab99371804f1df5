/// \file
/// Images as arguments (specification section 10).
#pragma once

#include <memory>

#include "api/openvg/image/pixels.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// Throws VG_BAD_HANDLE_ERROR, or VG_IMAGE_IN_USE_ERROR for an image that is drawn into.
std::shared_ptr<Image> freeImage(const Context& context, VGImage handle);

/// The nearest ancestor that has a handle; null if there is none.
std::shared_ptr<Image> parentOf(const Image& image);

/// Converts a word from one format to another (section 3.4.4).
std::uint32_t convertedWord(std::uint32_t word, const PixelFormat& from, const PixelFormat& to);

/// Copies pixels, each converted, between things that have words and a format: images, surfaces' pixels,
/// memory.
template <class From, class To>
void copyPixels(const From& from, To& to, const CopyArea& area) {
    for (int j = 0; j < area.height; ++j)
        for (int i = 0; i < area.width; ++i)
            to.setWord(area.dx + i, area.dy + j,
                       convertedWord(from.word(area.sx + i, area.sy + j), from.format(), to.format()));
}

/// A clear colour as a word of a format.
std::uint32_t wordOf(const std::array<VGfloat, 4>& sRGBAColor, const PixelFormat& format);

/// An image drawn by the context's state (section 10.8). `matrix`: the one that `toSurface` comes from.
void drawImage(Context& context, const Image& image, const glm::mat3& toSurface, VGMatrixMode matrix);

}  // namespace vtm::openvg

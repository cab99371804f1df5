/// \file
/// Images as arguments (specification section 10).
#pragma once

#include <memory>

#include "api/openvg/image/pixel_rows.hpp"
#include "api/openvg/state/context.hpp"

namespace vtm::openvg {

/// Throws VG_BAD_HANDLE_ERROR, or VG_IMAGE_IN_USE_ERROR for an image that is drawn into.
std::shared_ptr<Image> freeImage(const Context& context, VGImage handle);

/// The nearest ancestor that has a handle; null if there is none.
std::shared_ptr<Image> parentOf(const Image& image);

/// Copies pixels, each converted (section 3.4.4), between two different storages: images, surfaces' pixels,
/// programs' memory.
template <class From, class To>
void copyPixels(const From& from, To& to, const CopyArea& area) {
    convertRows({from.at(area.sx, area.sy), from.stride()}, from.format(),
                {to.at(area.dx, area.dy), to.stride()}, to.format(), area.width, area.height, convertRow);
}
template <class To>
void copyPixels(const MemoryPixels& from, To& to, const CopyArea& area) {
    if (!from.isPacked())
        return convertRows({from.at(area.sx, area.sy), from.stride}, from.format(),
                           {to.at(area.dx, area.dy), to.stride()}, to.format(), area.width, area.height,
                           takeRow);
    std::vector<std::uint8_t> bytes(std::size_t(area.width));
    for (int j = 0; j < area.height; ++j) {
        from.unpackRow(area.sx, area.sy + j, area.width, bytes.data());
        convertRow(bytes.data(), from.format(), to.at(area.dx, area.dy + j), to.format(), area.width);
    }
}
template <class From>
void copyPixels(const From& from, const MemoryPixels& to, const CopyArea& area) {
    if (!to.isPacked())
        return convertRows({from.at(area.sx, area.sy), from.stride()}, from.format(),
                           {to.at(area.dx, area.dy), to.stride}, to.format(), area.width, area.height,
                           convertRow);
    std::vector<std::uint8_t> bytes(std::size_t(area.width));
    for (int j = 0; j < area.height; ++j) {
        convertRow(from.at(area.sx, area.sy + j), from.format(), bytes.data(), to.format(), area.width);
        to.packRow(area.dx, area.dy + j, area.width, bytes.data());
    }
}

/// A clear colour as a word of a format.
std::uint32_t wordOf(const std::array<VGfloat, 4>& sRGBAColor, const PixelFormat& format);

/// An image drawn by the context's state (section 10.8). `matrix`: the one that `toSurface` comes from.
void drawImage(Context& context, const Image& image, const glm::mat3& toSurface, VGMatrixMode matrix);

}  // namespace vtm::openvg

/// \file
/// What all image filters do around their arithmetic (specification sections 12.1 and 12.2).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "api/openvg/image/image_filter.hpp"
#include "api/openvg/image/images.hpp"

namespace vtm::openvg {

/// Rows of colours.
struct Raster {
    int width = 0, height = 0;
    std::vector<Color> colors;

    Raster(int w, int h) : width(w), height(h), colors(std::size_t(w) * std::size_t(h)) {}
    Color& at(int x, int y) { return colors[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const Color& at(int x, int y) const { return const_cast<Raster*>(this)->at(x, y); }
    std::span<Color> row(int y) { return {&at(0, y), std::size_t(width)}; }
};

/// What a filter reads and where it writes; throws for images that it must not get.
struct FilterImages {
    std::shared_ptr<Image> dst, src;

    FilterImages(const Context& context, VGImage dstHandle, VGImage srcHandle);

    int width() const { return std::min(dst->width(), src->width()); }
    int height() const { return std::min(dst->height(), src->height()); }
};

/// VG_FILTER_FORMAT_LINEAR and VG_FILTER_FORMAT_PREMULTIPLIED.
ColorSpace filterSpace(const State& state);

/// Filters the images where the source's pixels are in a texture, from filterSpace() to `output`. False: that
/// is to be done in memory.
bool areFilteredInTextures(const Context& context, const FilterImages& images, ColorSpace output,
                           FilterArithmetic arithmetic);

/// Section 12.1. Grey is replicated, not converted.
void normalizedRow(const Image& image, int y, ColorSpace space, std::span<Color> colors);
Raster normalized(const Image& image, ColorSpace space);

/// Writes the row's filtered colours from the left on, the channels that VG_FILTER_CHANNEL_MASK names
/// (section 12.2). Clamps them in place.
void writeFilteredRow(const State& state, Image& image, int y, std::span<Color> colors, ColorSpace space);

/// The index of a place outside of 0 to size - 1, or -1 for the fill colour (section 9.4.1).
int tiled(int i, int size, VGTilingMode mode);
/// Of `first` to `end` - 1.
std::vector<int> tiledPlaces(int first, int end, int size, VGTilingMode mode);
bool isTiling(VGTilingMode mode);

/// VG_TILE_FILL_COLOR as normalized pixels are.
Color tileFillColor(const State& state, ColorSpace space);

}  // namespace vtm::openvg

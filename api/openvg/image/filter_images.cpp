#include "api/openvg/image/filter_images.hpp"

#include <algorithm>
#include <array>

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/paint/lanes.hpp"

namespace vtm::openvg {

FilterImages::FilterImages(const Context& context, VGImage dstHandle, VGImage srcHandle)
    : dst(context.objects->get<Image>(dstHandle)), src(context.objects->get<Image>(srcHandle)) {
    require(!dst->storage->isTarget && !src->storage->isTarget, VG_IMAGE_IN_USE_ERROR);
    require(dst->storage != src->storage || dst->area.intersected(src->area).empty());
}

ColorSpace filterSpace(const State& state) {
    return {state.filterFormatLinear, state.filterFormatPremultiplied, false};
}

bool areFilteredInTextures(const Context& context, const FilterImages& images, ColorSpace output,
                           FilterArithmetic arithmetic) {
    return compositorOf(context).filterImage(
        *images.dst, *images.src,
        {std::move(arithmetic), filterSpace(context.state), output, context.state.filterChannelMask});
}

void normalizedRow(const Image& image, int y, ColorSpace space, std::span<Color> colors) {
    decodeRow(image.format(), image.at(0, y), colors);
    ColorSpace from = image.format().space;
    from.luminance = false;
    convertColors(colors, from, space);
}

Raster normalized(const Image& image, ColorSpace space) {
    Raster raster(image.width(), image.height());
    for (int y = 0; y < raster.height; ++y)
        normalizedRow(image, y, space, raster.row(y));
    return raster;
}

namespace {

void clampColors(std::span<Color> colors, bool isPremultiplied) {
    for (Color& color : colors) {
        const Float4 c = unit(loaded(color));
        assign(color, isPremultiplied ? lesser(c, alphas(c)) : c);
    }
}

/// The channels that `mask` leaves out become those of the row that is there.
void keepChannels(VGbitfield mask, std::span<Color> colors, std::span<const Color> there) {
    constexpr std::array<VGbitfield, 4> bits{VG_RED, VG_GREEN, VG_BLUE, VG_ALPHA};
    for (int c = 0; c < 4; ++c)
        if (!(mask & bits[std::size_t(c)]))
            for (std::size_t x = 0; x < colors.size(); ++x)
                colors[x][c] = there[x][c];
}

}  // namespace

void writeFilteredRow(const State& state, Image& image, int y, std::span<Color> colors, ColorSpace space) {
    const PixelFormat& format = image.format();
    clampColors(colors, space.premultiplied);
    if (format.grey.bits == 0 && (state.filterChannelMask & allChannels) != allChannels) {
        ColorSpace plain = format.space;
        plain.premultiplied = false;
        std::vector<Color> there(colors.size());
        decodeRow(format, image.at(0, y), there);
        convertColors(there, format.space, plain);
        convertColors(colors, space, plain);
        keepChannels(state.filterChannelMask, colors, there);
        space = plain;
    }
    convertColors(colors, space, format.space);
    encodeRow(format, colors, image.at(0, y));
}

int tiled(int i, int size, VGTilingMode mode) {
    if (i >= 0 && i < size)
        return i;
    switch (mode) {
        case VG_TILE_PAD:
            return std::clamp(i, 0, size - 1);
        case VG_TILE_REPEAT:
            return (i % size + size) % size;
        case VG_TILE_REFLECT: {
            const int j = (i % (2 * size) + 2 * size) % (2 * size);
            return j < size ? j : 2 * size - 1 - j;
        }
        default:
            return -1;
    }
}

std::vector<int> tiledPlaces(int first, int end, int size, VGTilingMode mode) {
    std::vector<int> places;
    for (int i = first; i < end; ++i)
        places.push_back(tiled(i, size, mode));
    return places;
}

bool isTiling(VGTilingMode mode) { return VGint(mode) >= VG_TILE_FILL && VGint(mode) <= VG_TILE_REFLECT; }

Color tileFillColor(const State& state, ColorSpace space) { return givenColor(state.tileFillColor, space); }

}  // namespace vtm::openvg

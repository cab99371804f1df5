#include "api/openvg/image/filter_images.hpp"

#include <algorithm>
#include <array>

namespace vtm::openvg {

FilterImages::FilterImages(const Context& context, VGImage dstHandle, VGImage srcHandle)
    : dst(context.objects->get<Image>(dstHandle)), src(context.objects->get<Image>(srcHandle)) {
    require(!dst->storage->isTarget && !src->storage->isTarget, VG_IMAGE_IN_USE_ERROR);
    require(dst->storage != src->storage || dst->area.intersected(src->area).empty());
}

ColorSpace filterSpace(const State& state) {
    return {state.filterFormatLinear, state.filterFormatPremultiplied, false};
}

Color normalized(Color color, ColorSpace from, ColorSpace to) {
    from.luminance = false;
    return fullyConverted(color, from, to);
}

Raster normalized(const Image& image, ColorSpace space) {
    Raster raster(image.width(), image.height());
    for (int y = 0; y < raster.height; ++y)
        for (int x = 0; x < raster.width; ++x)
            raster.at(x, y) = normalized(image.color(x, y), image.format().space, space);
    return raster;
}

namespace {

Color clamped(Color color, ColorSpace space) {
    color = clampedToUnit(color);
    return space.premultiplied ? Color(glm::min(glm::vec3(color), color.a), color.a) : color;
}

}  // namespace

void writeFiltered(const State& state, Image& image, int x, int y, Color color, ColorSpace space) {
    const PixelFormat& format = image.format();
    color = clamped(color, space);
    const VGbitfield all = VG_RED | VG_GREEN | VG_BLUE | VG_ALPHA;
    if (format.grey.bits != 0 || (state.filterChannelMask & all) == all)
        return setWordAt(image.at(x, y), format.pixelBytes(),
                         format.encode(fullyConverted(color, space, format.space)));
    ColorSpace plain = format.space;
    plain.premultiplied = false;
    const Color filtered = fullyConverted(color, space, plain);
    Color result = fullyConverted(image.color(x, y), format.space, plain);
    constexpr std::array<VGbitfield, 4> bits{VG_RED, VG_GREEN, VG_BLUE, VG_ALPHA};
    for (int c = 0; c < 4; ++c)
        if (state.filterChannelMask & bits[std::size_t(c)])
            result[c] = filtered[c];
    setWordAt(image.at(x, y), format.pixelBytes(),
              format.encode(fullyConverted(result, plain, format.space)));
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

bool isTiling(VGTilingMode mode) { return VGint(mode) >= VG_TILE_FILL && VGint(mode) <= VG_TILE_REFLECT; }

Color tileFillColor(const State& state, ColorSpace space) { return givenColor(state.tileFillColor, space); }

}  // namespace vtm::openvg

// libavif brings four codecs, whose libraries would take a third of the command's start: it is loaded when
// the first AVIF picture comes, where it is installed.
#include <algorithm>
#include <string_view>

#include <vtm/image/codec.hpp>
#include "image/src/formats.hpp"

#ifdef VTM_WITH_AVIF
#include <cstring>
#include <memory>
#include <type_traits>

#include <dlfcn.h>

#include <avif/avif.h>
#endif

namespace vtm::image {

/// ISO/IEC 14496-12 section 4.3: a box `ftyp`, of one of AVIF's brands.
bool isAvif(Bytes bytes) {
    if (bytes.size() < 12)
        return false;
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()) + 4, 8);
    return head == "ftypavif" || head == "ftypavis" || head == "ftypmif1" || head == "ftypmiaf";
}

#ifndef VTM_WITH_AVIF

Bitmap decodeAvif(Bytes) { throw CodecError("AVIF: built without libavif (libavif-dev)"); }

#else

namespace {

/// Its functions, from its library. It stays loaded.
struct Avif {
    decltype(&avifDecoderCreate) create = nullptr;
    decltype(&avifDecoderDestroy) destroy = nullptr;
    decltype(&avifDecoderSetIOMemory) setMemory = nullptr;
    decltype(&avifDecoderParse) parse = nullptr;
    decltype(&avifDecoderNextImage) next = nullptr;
    decltype(&avifRGBImageSetDefaults) setDefaults = nullptr;
    decltype(&avifImageYUVToRGB) toRgb = nullptr;
    decltype(&avifResultToString) text = nullptr;
    decltype(&avifCodecName) codecName = nullptr;

    Avif() {
        void* const library = dlopen(VTM_AVIF_LIBRARY, RTLD_NOW | RTLD_LOCAL);
        if (!library)
            return;
        const auto find = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)> >(dlsym(library, name));
        };
        find(create, "avifDecoderCreate");
        find(destroy, "avifDecoderDestroy");
        find(setMemory, "avifDecoderSetIOMemory");
        find(parse, "avifDecoderParse");
        find(next, "avifDecoderNextImage");
        find(setDefaults, "avifRGBImageSetDefaults");
        find(toRgb, "avifImageYUVToRGB");
        find(text, "avifResultToString");
        find(codecName, "avifCodecName");
    }
    bool isThere() const {
        return create && destroy && setMemory && parse && next && setDefaults && toRgb && text && codecName;
    }
};

const Avif& avif() {
    static const Avif loaded;
    if (!loaded.isThere())
        throw CodecError("AVIF: " VTM_AVIF_LIBRARY " is not installed");
    return loaded;
}

void require(avifResult result) {
    if (result != AVIF_RESULT_OK)
        throw CodecError(std::string("AVIF: ") + avif().text(result));
}

std::uint32_t* pixelOf(Bitmap& bitmap, int x, int y) {
    return reinterpret_cast<std::uint32_t*>(bitmap.rgba.data()) + std::ptrdiff_t(y) * bitmap.width + x;
}

/// Turned anticlockwise by so many quarters.
Bitmap turned(Bitmap from, int quarters) {
    if (quarters == 0)
        return from;
    const bool swaps = quarters % 2 == 1;
    Bitmap to = makeBitmap(swaps ? from.height : from.width, swaps ? from.width : from.height);
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x) {
            const int right = from.width - 1 - x, below = from.height - 1 - y;
            const int toX = quarters == 1 ? y : quarters == 2 ? right : below;
            const int toY = quarters == 1 ? right : quarters == 2 ? below : x;
            *pixelOf(to, toX, toY) = *pixelOf(from, x, y);
        }
    return to;
}

void mirror(Bitmap& bitmap, bool upsideDown) {
    for (int y = 0; y < (upsideDown ? bitmap.height / 2 : bitmap.height); ++y)
        if (upsideDown)
            std::swap_ranges(pixelOf(bitmap, 0, y), pixelOf(bitmap, 0, y) + bitmap.width,
                             pixelOf(bitmap, 0, bitmap.height - 1 - y));
        else
            std::reverse(pixelOf(bitmap, 0, y), pixelOf(bitmap, 0, y) + bitmap.width);
}

}  // namespace

/// The first picture of a sequence. Its colours are taken for sRGB.
Bitmap decodeAvif(Bytes bytes) {
    const Avif& library = avif();
    const std::unique_ptr<avifDecoder, decltype(library.destroy)> decoder(library.create(), library.destroy);
    if (!decoder)
        throw std::bad_alloc();
    // dav1d, which libavif prefers, prints what it finds damaged.
    if (library.codecName(AVIF_CODEC_CHOICE_AOM, AVIF_CODEC_FLAG_CAN_DECODE) != nullptr)
        decoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
    decoder->maxThreads = 1;
    decoder->imageSizeLimit = std::uint32_t(maxDecodedPixels);
    decoder->strictFlags = AVIF_STRICT_DISABLED;
    require(library.setMemory(decoder.get(), bytes.data(), bytes.size()));
    require(library.parse(decoder.get()));
    const avifImage& image = *decoder->image;
    Bitmap bitmap = makeBitmap(image.width, image.height);
    require(library.next(decoder.get()));
    if (int(decoder->image->width) != bitmap.width || int(decoder->image->height) != bitmap.height)
        throw CodecError("AVIF: the picture has another size than its header");
    avifRGBImage rgb{};
    library.setDefaults(&rgb, decoder->image);
    rgb.format = AVIF_RGB_FORMAT_RGBA;
    rgb.depth = 8;
    rgb.pixels = bitmap.rgba.data();
    rgb.rowBytes = std::uint32_t(bitmap.width) * 4;
    require(library.toRgb(decoder->image, &rgb));
    // ISO/IEC 23008-12 sections 6.5.10 and 6.5.12: turned first, then mirrored.
    if (image.transformFlags & AVIF_TRANSFORM_IROT)
        bitmap = turned(std::move(bitmap), image.irot.angle % 4);
    if (image.transformFlags & AVIF_TRANSFORM_IMIR)
        mirror(bitmap, image.imir.mode == 0);
    return bitmap;
}

#endif

}  // namespace vtm::image

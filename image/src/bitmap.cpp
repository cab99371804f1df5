#include <vtm/image/bitmap.hpp>

#include "image/pixel_writer.hpp"

namespace vtm::image {

Bitmap toBitmap(const Raster& raster) {
    Bitmap bitmap{raster.width, raster.height, std::vector<std::uint8_t>(raster.rgba.size())};
    const PixelWriter writer;
    for (std::size_t i = 0; i < raster.rgba.size(); i += 4)
        writer.write(&raster.rgba[i], &bitmap.rgba[i]);
    return bitmap;
}

Raster toRaster(const Bitmap& bitmap) {
    Raster raster(bitmap.width, bitmap.height);
    for (std::size_t i = 0; i < bitmap.rgba.size(); i += 4) {
        const float alpha = static_cast<float>(bitmap.rgba[i + 3]) / 255.0f;
        for (std::size_t c = 0; c < 3; ++c)
            raster.rgba[i + c] = static_cast<float>(bitmap.rgba[i + c]) / 255.0f * alpha;
        raster.rgba[i + 3] = alpha;
    }
    return raster;
}

}  // namespace vtm::image

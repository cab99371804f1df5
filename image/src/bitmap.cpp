#include <vtm/image/bitmap.hpp>

#include <algorithm>
#include <cmath>

namespace vtm::image {
namespace {

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

Bitmap toBitmap(const Raster& raster) {
    Bitmap bitmap{raster.width, raster.height, std::vector<std::uint8_t>(raster.rgba.size())};
    for (std::size_t i = 0; i < raster.rgba.size(); i += 4) {
        const float alpha = raster.rgba[i + 3];
        const float scale = alpha > 0 ? 1 / alpha : 0;
        for (std::size_t c = 0; c < 3; ++c)
            bitmap.rgba[i + c] = toByte(raster.rgba[i + c] * scale);
        bitmap.rgba[i + 3] = toByte(alpha);
    }
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

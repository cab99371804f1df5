// VG_KHR_EGL_image, and the functions of vtm/vg_image.h.

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include <vtm/vg_image.h>
#include "api/openvg/image/images.hpp"
#include "api/openvg/image/shared_pixels.hpp"
#include "api/openvg/state/objects.hpp"

struct VtmSharedImage {
    explicit VtmSharedImage(std::shared_ptr<const vtm::openvg::SharedPixels> shared)
        : pixels(std::move(shared)), storage(pixels->storage), area(pixels->area) {}

    std::shared_ptr<const vtm::openvg::SharedPixels> pixels;  ///< null: it will have no name any more
    const std::weak_ptr<vtm::openvg::ImageStorage> storage;
    const vtm::openvg::Rectangle area;
    VGeglImageKHR name = nullptr;
    std::vector<std::uint8_t> stored, bytes;  ///< when last taken or put; empty before
};

namespace vtm::openvg {

namespace {

/// What names stand for, in all contexts. Never destroyed: programs may call at any time.
struct Names {
    std::mutex mutex;
    std::map<VGeglImageKHR, VtmSharedImage*> images;
};
Names& names() {
    static auto& names = *new Names;
    return names;
}

/// Null if the name is none.
std::shared_ptr<const SharedPixels> pixelsOf(VGeglImageKHR name) {
    const std::lock_guard lock(names().mutex);
    const auto it = names().images.find(name);
    return it == names().images.end() ? nullptr : it->second->pixels;
}

/// With the lock held.
void forgetName(VtmSharedImage& image) {
    names().images.erase(image.name);
    image.name = nullptr;
}

/// As numbers are stored: red, green, blue, alpha.
std::array<std::uint8_t, 4> bytesOf(const Pixels& pixels, int x, int y) {
    const Color color = pixels.format().decode(pixels.word(x, y)) * 255.0f + 0.5f;
    return {std::uint8_t(color.r), std::uint8_t(color.g), std::uint8_t(color.b), std::uint8_t(color.a)};
}

std::shared_ptr<const SharedPixels> shared(Context& context, VGImage handle) {
    const std::lock_guard lock(context.objects->mutex);
    const std::shared_ptr<Image> image = context.objects->get<Image>(handle);
    const std::shared_ptr<ImageStorage>& storage = image->storage;
    require(parentOf(*image) == nullptr && storage->shared.expired(), VG_IMAGE_IN_USE_ERROR);
    // Whatever else holds it is a surface.
    require(!storage->isTarget && storage.use_count() == storage->images, VG_IMAGE_IN_USE_ERROR);
    auto pixels = std::make_shared<const SharedPixels>(
        SharedPixels{storage, image->area, image->formatName, image->allowedQuality});
    storage->shared = pixels;
    return pixels;
}

}  // namespace

}  // namespace vtm::openvg

using namespace vtm::openvg;

VtmSharedImage* vtmShareImage(VtmContext* context, VGImage handle, VGErrorCode* error) {
    return madeOrNull(error, [&] {
        require(context != nullptr, VG_BAD_HANDLE_ERROR);
        return new VtmSharedImage(shared(*context, handle));
    });
}

void vtmDestroySharedImage(VtmSharedImage* image) {
    if (!image)
        return;
    {
        const std::lock_guard lock(names().mutex);
        forgetName(*image);
    }
    delete image;
}

VGboolean vtmNameSharedImage(VtmSharedImage* image, VGeglImageKHR name) try {
    const std::lock_guard lock(names().mutex);
    if (!name) {
        forgetName(*image);
        image->pixels = nullptr;
        return VG_TRUE;
    }
    auto& images = names().images;
    if (!image->pixels)
        return VG_FALSE;
    if (!images.try_emplace(name, image).second)
        return VG_FALSE;
    forgetName(*image);
    image->name = name;
    return VG_TRUE;
} catch (const std::bad_alloc&) {
    return VG_FALSE;
}

VGint vtmSharedImageWidth(const VtmSharedImage* image) { return image->area.x1 - image->area.x0; }
VGint vtmSharedImageHeight(const VtmSharedImage* image) { return image->area.y1 - image->area.y0; }

VtmPixels vtmTakeSharedPixels(VtmSharedImage* image, void* to) {
    const std::shared_ptr<ImageStorage> storage = image->storage.lock();
    if (!storage)
        return VTM_PIXELS_GONE;
    const Pixels& pixels = storage->pixels.read();
    const std::size_t rowBytes = std::size_t(vtmSharedImageWidth(image)) * pixels.pixelBytes();
    std::vector<std::uint8_t> stored;
    stored.reserve(rowBytes * std::size_t(vtmSharedImageHeight(image)));
    for (int y = image->area.y0; y < image->area.y1; ++y) {
        const std::uint8_t* row = pixels.at(image->area.x0, y);
        stored.insert(stored.end(), row, row + rowBytes);
    }
    if (stored == image->stored)
        return VTM_PIXELS_SAME;
    image->stored = std::move(stored);
    image->bytes.clear();
    for (int y = image->area.y0; y < image->area.y1; ++y)
        for (int x = image->area.x0; x < image->area.x1; ++x) {
            const std::array<std::uint8_t, 4> bytes = bytesOf(pixels, x, y);
            image->bytes.insert(image->bytes.end(), bytes.begin(), bytes.end());
        }
    std::ranges::copy(image->bytes, static_cast<std::uint8_t*>(to));
    return VTM_PIXELS_CHANGED;
}

void vtmPutSharedPixels(VtmSharedImage* image, const void* from) {
    const std::shared_ptr<ImageStorage> storage = image->storage.lock();
    if (!storage || image->bytes.empty())
        return;
    Pixels& pixels = storage->pixels.write();
    const auto* bytes = static_cast<const std::uint8_t*>(from);
    std::size_t i = 0;
    for (int y = image->area.y0; y < image->area.y1; ++y)
        for (int x = image->area.x0; x < image->area.x1; ++x, i += 4) {
            if (std::equal(bytes + i, bytes + i + 4, image->bytes.data() + i))
                continue;
            const Color color(bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]);
            pixels.setWord(x, y, pixels.format().encode(color / 255.0f));
            std::copy_n(bytes + i, 4, image->bytes.data() + i);
            std::copy_n(pixels.at(x, y), pixels.pixelBytes(),
                        image->stored.data() + i / 4 * pixels.pixelBytes());
        }
}

VGImage vgCreateEGLImageTargetKHR(VGeglImageKHR name) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        std::shared_ptr<const SharedPixels> pixels = pixelsOf(name);
        if (!pixels)
            pixels = foreignPixels(context, name);
        require(pixels != nullptr);
        auto image = std::make_shared<Image>(pixels->storage, pixels->area);
        image->formatName = pixels->formatName;
        image->allowedQuality = pixels->allowedQuality;
        image->siblings = pixels;
        return context.objects->add(std::move(image));
    });
}

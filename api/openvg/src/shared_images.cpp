// VG_KHR_EGL_image, and the functions of vtm/vg_image.h.

#include "api/openvg/src/shared_images.hpp"

#include <map>
#include <mutex>

#include "api/openvg/src/images.hpp"

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
    VGErrorCode code = VG_NO_ERROR;
    VtmSharedImage* result = nullptr;
    try {
        require(context != nullptr, VG_BAD_HANDLE_ERROR);
        auto image = std::make_unique<VtmSharedImage>();
        image->pixels = shared(*context, handle);
        result = image.release();
    } catch (const Error& e) {
        code = e.code;
    } catch (const std::bad_alloc&) {
        code = VG_OUT_OF_MEMORY_ERROR;
    }
    if (error)
        *error = code;
    return result;
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
    if (!name)
        return VG_FALSE;
    const std::lock_guard lock(names().mutex);
    auto& images = names().images;
    if (!images.try_emplace(name, image).second)
        return VG_FALSE;
    forgetName(*image);
    image->name = name;
    return VG_TRUE;
} catch (const std::bad_alloc&) {
    return VG_FALSE;
}

VGImage vgCreateEGLImageTargetKHR(VGeglImageKHR name) {
    return callOr(VG_INVALID_HANDLE, [&](Context& context) {
        const std::shared_ptr<const SharedPixels> pixels = pixelsOf(name);
        require(pixels != nullptr);
        auto image = std::make_shared<Image>(pixels->storage, pixels->area);
        image->formatName = pixels->formatName;
        image->allowedQuality = pixels->allowedQuality;
        image->siblings = pixels;
        return context.objects->add(std::move(image));
    });
}

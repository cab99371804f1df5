// Section 4: contexts, surfaces, errors, completion.

#include "api/openvg/state/context.hpp"

#include <algorithm>
#include <cstring>

#include <dlfcn.h>

#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/image/pixel_rows.hpp"
#include "api/openvg/image/shared_pixels.hpp"

namespace vtm::openvg {

namespace {

/// Guards who is current where.
std::mutex& currentMutex() {
    static std::mutex mutex;
    return mutex;
}

void free(Context* context) {
    // Other contexts may be using the objects whose last owner this one is not.
    const std::shared_ptr<Handles> objects = context->objects;
    const std::lock_guard lock(objects->mutex);
    delete context;
}

/// Lets go of what a thread had current.
void release(Context* context) {
    Surface* const surface = context->surface;
    context->surface = nullptr;
    surface->user = nullptr;
    surface->storage->isTarget = false;
    if (surface->isDestroyed)
        delete surface;
    if (context->isDestroyed)
        free(context);
}

/// Of this thread; a thread that ends with a context lets go of it.
struct Current {
    Context* context = nullptr;
    ~Current() {
        if (!context)
            return;
        const std::lock_guard lock(currentMutex());
        release(context);
    }
};
thread_local Current current;

std::optional<PixelFormat> surfaceFormat(const VtmSurfaceFormat& f) {
    PixelFormat format;
    format.space = {f.linear != VG_FALSE, f.premultiplied != VG_FALSE, f.luminanceBits != 0};
    const auto is = [&](VGint r, VGint g, VGint b, VGint a, VGint l) {
        return f.redBits == r && f.greenBits == g && f.blueBits == b && f.alphaBits == a &&
               f.luminanceBits == l;
    };
    const bool isColor =
        is(8, 8, 8, 8, 0) || is(8, 8, 8, 0, 0) || is(5, 6, 5, 0, 0) || is(5, 5, 5, 1, 0) || is(4, 4, 4, 4, 0);
    if (isColor) {
        // Bytes in memory are red, green, blue, alpha, whole pixels native words otherwise.
        format.bits = f.redBits == 8 ? 32 : 16;
        unsigned shift = 0;
        const auto next = [&](VGint bits) {
            const Channel channel{std::uint8_t(bits), std::uint8_t(shift)};
            shift += unsigned(bits);
            return channel;
        };
        if (f.redBits == 8) {
            format.red = next(8);
            format.green = next(8);
            format.blue = next(8);
            format.alpha = next(f.alphaBits);
        } else {
            format.alpha = next(f.alphaBits);
            format.blue = next(f.blueBits);
            format.green = next(f.greenBits);
            format.red = next(f.redBits);
        }
        return format;
    }
    if (is(0, 0, 0, 8, 0)) {
        format.bits = 8;
        format.alpha = {8, 0};
        return format;
    }
    if (is(0, 0, 0, 0, 8) || is(0, 0, 0, 0, 1)) {
        format.bits = unsigned(f.luminanceBits);
        format.grey = {std::uint8_t(f.luminanceBits), 0};
        return format;
    }
    return std::nullopt;
}

/// Rows from the highest one on.
void readFromTop(const Surface& surface, const PixelFormat& format, const Rectangle& part, void* to,
                 std::size_t rowBytes) {
    const Pixels& pixels = surface.pixels().read();
    const auto stride = std::ptrdiff_t(rowBytes);
    const int width = part.x1 - part.x0, height = part.y1 - part.y0;
    convertRows({pixels.at(part.x0, part.y0), pixels.stride()}, pixels.format(),
                {static_cast<std::uint8_t*>(to) + (height - 1) * stride, -stride}, format, width, height,
                convertRow);
}

bool isSide(VGint side) { return side >= 1 && side <= maxSurfaceSide; }
bool isMask(VGint bits) { return bits == 0 || bits == 8; }

}  // namespace

Context* currentContext() { return current.context; }

PixelFormat bytesFormat() { return *surfaceFormat({8, 8, 8, 8, 0, 0, VG_FALSE, VG_TRUE}); }

}  // namespace vtm::openvg

using namespace vtm::openvg;

// ---- vtm/vg.h -------------------------------------------------------------------------------------

VtmSurface* vtmCreateSurface(VGint width, VGint height, const VtmSurfaceFormat* format) try {
    const std::optional<PixelFormat> pixelFormat = format ? surfaceFormat(*format) : std::nullopt;
    if (!pixelFormat || !isMask(format->maskBits) || !isSide(width) || !isSide(height))
        return nullptr;
    auto surface = std::make_unique<VtmSurface>();
    surface->storage = std::make_shared<ImageStorage>(Pixels(width, height, *pixelFormat));
    surface->compositor = &chosenCompositor(VTM_COMPOSITOR_AUTOMATIC);
    if (format->maskBits != 0)
        surface->mask.emplace(width, height);
    return surface.release();
} catch (const std::bad_alloc&) {
    return nullptr;
}

VtmSurface* vtmCreateImageSurface(VtmContext* context, VGImage image, VGint maskBits, VGErrorCode* error) {
    return madeOrNull(error, [&] {
        require(context != nullptr && isMask(maskBits));
        const std::lock_guard lock(context->objects->mutex);
        const std::shared_ptr<Image> target = context->objects->get<Image>(image);
        const ImageStorage& storage = *target->storage;
        require(!storage.isTarget && storage.images == 1 && storage.uses == 0, VG_IMAGE_IN_USE_ERROR);
        // Another surface holds it.
        require(target->storage.use_count() == storage.images, VG_IMAGE_IN_USE_ERROR);
        require(isSide(target->width()) && isSide(target->height()));
        auto surface = std::make_unique<VtmSurface>();
        surface->storage = target->storage;
        surface->isImage = true;
        surface->compositor = &chosenCompositor(VTM_COMPOSITOR_AUTOMATIC);
        if (maskBits != 0)
            surface->mask.emplace(target->width(), target->height());
        return surface.release();
    });
}

VtmCompositor vtmChooseCompositor(VtmSurface* surface, VtmCompositor compositor) {
    surface->compositor = &chosenCompositor(compositor);
    return vtmGetCompositor(surface);
}

VtmCompositor vtmGetCompositor(const VtmSurface* surface) {
    return surface->compositor == &cpuCompositor() ? VTM_COMPOSITOR_CPU : VTM_COMPOSITOR_GL;
}

const char* vtmGetCompositorFault(void) { return compositorFault(); }

void vtmDestroySurface(VtmSurface* surface) {
    if (!surface)
        return;
    const std::lock_guard lock(currentMutex());
    if (surface->user)
        surface->isDestroyed = true;
    else
        delete surface;
}

VGboolean vtmResizeSurface(VtmSurface* surface, VGint width, VGint height) try {
    if (surface->isImage || !isSide(width) || !isSide(height))
        return VG_FALSE;
    const Pixels& old = surface->pixels().read();
    Pixels pixels(width, height, old.format());
    const int columns = std::min(width, old.width()), rows = std::min(height, old.height());
    for (int y = 0; y < rows; ++y)
        std::memcpy(pixels.at(0, y), old.at(0, y), std::size_t(columns) * old.pixelBytes());
    std::optional<MaskValues> mask;
    if (surface->mask) {
        mask.emplace(width, height);
        for (int y = 0; y < rows; ++y)
            std::copy_n(surface->mask->row(y), columns, mask->row(y));
    }
    surface->pixels().replace(std::move(pixels));
    surface->mask = std::move(mask);
    return VG_TRUE;
} catch (const std::bad_alloc&) {
    return VG_FALSE;
}

VGint vtmSurfaceWidth(const VtmSurface* surface) { return surface->width(); }
VGint vtmSurfaceHeight(const VtmSurface* surface) { return surface->height(); }

void vtmGetSurfaceFormat(const VtmSurface* surface, VtmSurfaceFormat* result) {
    const PixelFormat& format = surface->pixels().format();
    *result = {format.red.bits,
               format.green.bits,
               format.blue.bits,
               format.alpha.bits,
               format.grey.bits,
               surface->mask ? 8 : 0,
               VGboolean(format.space.linear),
               VGboolean(format.space.premultiplied)};
}

void vtmReadSurface(VtmSurface* surface, void* bytes, size_t rowBytes) {
    vtmReadSurfacePart(surface, 0, 0, surface->width(), surface->height(), bytes, rowBytes);
}

void vtmReadSurfacePart(VtmSurface* surface, VGint x0, VGint y0, VGint width, VGint height, void* bytes,
                        size_t rowBytes) {
    readFromTop(*surface, bytesFormat(), {x0, y0, x0 + width, y0 + height}, bytes, rowBytes);
}
VGboolean vtmReadSurfaceAs(VtmSurface* surface, VGImageFormat name, VGint x0, VGint y0, VGint width,
                           VGint height, void* pixels, size_t rowBytes) {
    const std::optional<PixelFormat> format = imageFormat(VGint(name));
    if (!format || format->bits < 8)
        return VG_FALSE;
    readFromTop(*surface, *format, {x0, y0, x0 + width, y0 + height}, pixels, rowBytes);
    return VG_TRUE;
}

void vtmWriteSurface(VtmSurface* surface, const void* bytes, size_t rowBytes) {
    Pixels& pixels = surface->pixels().write();
    const auto stride = std::ptrdiff_t(rowBytes);
    convertRows({static_cast<const std::uint8_t*>(bytes) + (pixels.height() - 1) * stride, -stride},
                bytesFormat(), {pixels.at(0, 0), pixels.stride()}, pixels.format(), pixels.width(),
                pixels.height(), takeRow);
}

VtmContext* vtmCreateContext(VtmContext* share) try {
    auto context = std::make_unique<VtmContext>();
    context->objects = share ? share->objects : std::make_shared<Handles>();
    return context.release();
} catch (const std::bad_alloc&) {
    return nullptr;
}

void vtmDestroyContext(VtmContext* context) {
    if (!context)
        return;
    const std::lock_guard lock(currentMutex());
    if (context->surface)
        context->isDestroyed = true;
    else
        free(context);
}

VGboolean vtmMakeCurrent(VtmContext* context, VtmSurface* surface) {
    if ((context == nullptr) != (surface == nullptr))
        return VG_FALSE;
    const std::lock_guard lock(currentMutex());
    Context* const old = current.context;
    if (context) {
        if ((context->surface && context != old) || (surface->user && surface->user != old))
            return VG_FALSE;
        if (context == old && context->surface == surface)
            return VG_TRUE;
        if (surface->isImage) {
            const std::lock_guard objectsLock(context->objects->mutex);
            if (surface->storage->uses != 0)
                return VG_FALSE;
        }
    }
    // Neither may go with what is released, if it is used again.
    const bool keepsContext = context && context == old, keepsSurface = surface && surface->user;
    const bool contextWasDestroyed = keepsContext && std::exchange(context->isDestroyed, false);
    const bool surfaceWasDestroyed = keepsSurface && std::exchange(surface->isDestroyed, false);
    if (old)
        release(old);
    current.context = context;
    if (!context)
        return VG_TRUE;
    context->isDestroyed = contextWasDestroyed;
    surface->isDestroyed = surfaceWasDestroyed;
    context->surface = surface;
    surface->user = context;
    surface->storage->isTarget = true;
    if (surface->mask)
        surface->mask->fill(255);
    return VG_TRUE;
}

VtmContext* vtmGetCurrentContext(void) { return currentContext(); }
VtmSurface* vtmGetCurrentSurface(void) { return currentContext() ? currentContext()->surface : nullptr; }

VtmFunction vtmGetProcAddress(const char* name) {
    if (!name || (std::strncmp(name, "vg", 2) != 0 && std::strncmp(name, "vtm", 3) != 0))
        return nullptr;
    // This library by the place of one of its functions, however it was loaded.
    Dl_info info;
    if (dladdr(reinterpret_cast<void*>(&vtmGetProcAddress), &info) == 0)
        return nullptr;
    void* const library = dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    if (!library)
        return nullptr;
    const auto function = reinterpret_cast<VtmFunction>(dlsym(library, name));
    dlclose(library);
    return function;
}

// ---- Sections 4.1 and 4.3 -------------------------------------------------------------------------

VGErrorCode vgGetError(void) {
    Context* const context = currentContext();
    return context ? std::exchange(context->error, VG_NO_ERROR) : VG_NO_CONTEXT_ERROR;
}

void vgFlush(void) {
    call([](Context& context) { compositorOf(context).flush(); });
}
void vgFinish(void) {
    call([](Context& context) {
        compositorOf(context).finish();
        handOverPixels();
    });
}

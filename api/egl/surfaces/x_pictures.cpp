#include "api/egl/surfaces/x_pictures.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <dlfcn.h>

#include "api/egl/state/configs.hpp"

namespace vtm::egl {

namespace {

/// What eglGetDisplay was given is an X11 Display where configs have X11's classes of visuals.
bool hasVisuals(const Display& display) {
    constexpr EGLint staticGray = 0, directColor = 5;
    const std::vector<EGLConfig> configs = systemConfigs(display);
    return std::ranges::any_of(configs, [&](EGLConfig config) {
        const EGLint visual = systemConfigAttribute(display, config, EGL_NATIVE_VISUAL_TYPE);
        return visual > staticGray && visual <= directColor;
    });
}

std::string nameOf(const Display& display) {
    if (!display.native || !hasVisuals(display))
        return {};
    if (*display.native == nullptr) {
        const char* const name = std::getenv("DISPLAY");
        return name ? name : "";
    }
    // The program has loaded it, since it has a Display.
    void* const library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    const auto displayString =
        library ? reinterpret_cast<const char* (*)(void*)>(dlsym(library, "XDisplayString")) : nullptr;
    return displayString ? displayString(*display.native) : "";
}

/// Five, six and five bits of pixels without regard to alpha: over black.
void toSmallWords(const std::uint8_t* pixels, int count, std::uint8_t* words) {
    for (int i = 0; i < count; ++i, pixels += 4, words += 2) {
        const auto word = std::uint16_t((pixels[0] & 0xf8) << 8 | (pixels[1] & 0xfc) << 3 | pixels[2] >> 3);
        std::memcpy(words, &word, 2);
    }
}

void copyDrawing(VtmSurface* drawing, const XServer::Drawable& to, std::uint8_t* picture) {
    static_assert(std::endian::native == std::endian::little);
    if (to.depth != 16) {
        vtmReadSurfaceAs(drawing, VG_sARGB_8888_PRE, 0, 0, to.width, to.height, picture, to.rowBytes());
        return;
    }
    std::vector<std::uint8_t> pixels(std::size_t(to.width) * 4);
    for (int y = 0; y < to.height; ++y) {
        vtmReadSurfacePart(drawing, 0, to.height - 1 - y, to.width, 1, pixels.data(), pixels.size());
        toSmallWords(pixels.data(), to.width, picture + std::size_t(y) * to.rowBytes());
    }
}

}  // namespace

std::uintptr_t platformDrawable(const Display& display, const void* native) {
    // The address of an XID: those are unsigned long.
    return native && display.native && hasVisuals(display) ? *static_cast<const unsigned long*>(native) : 0;
}

XPicture::XPicture(const Display& display)
    : server_(display.systemRuns ? XServer::named(nameOf(display)) : nullptr) {}

bool XPicture::put(std::uintptr_t drawable, VtmSurface* drawing) {
    const auto target = server_ ? server_->find(drawable) : std::nullopt;
    if (!target || target->width != vtmSurfaceWidth(drawing) || target->height != vtmSurfaceHeight(drawing) ||
        (target->depth != 16 && target->depth != 24 && target->depth != 32))
        return false;
    const std::size_t bytes = target->rowBytes() * std::size_t(target->height);
    if (!shared_ || shared_->size() < bytes)
        shared_ = server_->share(bytes);
    if (shared_) {
        copyDrawing(drawing, *target, shared_->bytes());
        server_->put(*target, *shared_);
    } else {
        std::vector<std::uint8_t> picture(bytes);
        copyDrawing(drawing, *target, picture.data());
        server_->put(*target, picture.data());
    }
    return server_->find(drawable).has_value();
}

}  // namespace vtm::egl

// Section 3.9: EGLImages. Those of OpenVG's images are ours (EGL_KHR_image_base, EGL_KHR_vg_parent_image),
// all others the system's, which OpenVG may use too.

#include "api/egl/images/images.hpp"

#include <algorithm>
#include <atomic>

#include "api/egl/images/gl_image.hpp"
#include "api/egl/images/imported_pixels.hpp"
#include "api/egl/state/attributes.hpp"
#include "api/egl/state/thread.hpp"

namespace vtm::egl {

namespace {

constexpr EGLImage none = EGL_NO_IMAGE;

/// True if the system need not be asked.
bool isOfVg(EGLContext context, EGLenum target) {
    return target == EGL_VG_PARENT_IMAGE_KHR || contexts().has(context);
}

template <class Number>
void requireImageAttributes(const Number* list) {
    for (const auto& [attribute, value] : attributeList(list))
        require(attribute == EGL_IMAGE_PRESERVED && (value == EGL_TRUE || value == EGL_FALSE),
                EGL_BAD_PARAMETER);
}

template <class F>
F* systemsExtension(EGLDisplay dpy, const char* name) {
    return isForSystem(dpy) ? reinterpret_cast<F*>(systemEgl()->GetProcAddress(name)) : nullptr;
}

/// What textures of OpenGL show, also after the program has destroyed the EGLImage.
struct Shown {
    std::mutex mutex;
    std::vector<std::shared_ptr<Image>> all;
    std::atomic<bool> isEmpty = true;

    /// With the lock held.
    template <class Is>
    void drop(Is&& is) {
        std::erase_if(all, is);
        isEmpty = all.empty();
    }
};
Shown& shown() {
    static auto& shown = *new Shown;
    return shown;
}

/// `mayGlHaveDrawn`: also the other way.
void synchronizeShown(bool mayGlHaveDrawn) {
    if (shown().isEmpty)
        return;
    const std::lock_guard lock(shown().mutex);
    shown().drop([&](const auto& image) {
        try {
            return !image->gl->synchronize(mayGlHaveDrawn);
        } catch (const Error&) {
            return false;  // not now
        }
    });
}

/// Where the system has OpenGL ES, its drivers know the image.
void showInGl(const std::shared_ptr<Image>& image) {
    if (!image->display.systemRuns)
        return;
    const std::lock_guard lock(shown().mutex);
    // Of an EGLImage that is destroyed: the source is no sibling any more, or it could not be shared again.
    shown().drop([&](const auto& other) { return other->source == image->source; });
    try {
        image->gl = std::make_unique<GlImage>(image->display, image->shared);
    } catch (const Error&) {
        return;
    }
    image->handle = image->gl->handle();
    vtmSetFinishFunction([] { synchronizeShown(false); });
    shown().all.push_back(image);
    shown().isEmpty = false;
}

/// Textures go on showing it.
void retire(Image& image) {
    const std::lock_guard lock(shown().mutex);
    vtmNameSharedImage(image.shared, nullptr);
    if (image.gl)
        image.gl->destroyHandle();
}

EGLBoolean destroyImage(EGLDisplay dpy, EGLImage handle) {
    return call(EGLBoolean(EGL_FALSE), [&] {
        const Display& display = initializedDisplay(dpy);
        const auto image = images().find(handle);
        require(image && &image->display == &display, EGL_BAD_PARAMETER);
        images().remove(handle);
        retire(*image);
        return EGLBoolean(EGL_TRUE);
    });
}

/// Pixels are preserved, whether that was asked for or not.
template <class Number>
EGLImage createImage(EGLDisplay dpy, EGLContext handle, EGLenum target, EGLClientBuffer buffer,
                     const Number* list) {
    Display& display = initializedDisplay(dpy);
    EGLint id = 0;
    require(contexts().has(handle) || !display.systemRuns ||
                !systemEgl()->QueryContext(display.handle, handle, EGL_CONFIG_ID, &id),
            EGL_BAD_MATCH);
    const auto context = getContext(display, handle);
    require(target == EGL_VG_PARENT_IMAGE_KHR, EGL_BAD_PARAMETER);
    requireImageAttributes(list);
    const auto number = reinterpret_cast<std::uintptr_t>(buffer);
    require(number != 0 && number <= UINT32_MAX, EGL_BAD_PARAMETER);
    VGErrorCode error = VG_NO_ERROR;
    VtmSharedImage* const shared = vtmShareImage(context->drawing, VGImage(number), &error);
    require(shared != nullptr, errorOf(error));
    const auto image = std::make_shared<Image>(display, VGImage(number), shared);
    showInGl(image);
    images().add(image);
    if (!vtmNameSharedImage(shared, image->handle)) {
        images().remove(image->handle);
        retire(*image);
        throw Error{EGL_BAD_ALLOC};
    }
    return image->handle;
}

}  // namespace

Image::Image(Display& d, VGImage image, VtmSharedImage* pixels) : display(d), source(image), shared(pixels) {}

Image::~Image() {
    gl.reset();
    vtmDestroySharedImage(shared);
}

void synchronizeImages() {
    if (haveImported())
        synchronizeImported();
    synchronizeShown(systemEgl() && systemEgl()->GetCurrentContext() != EGL_NO_CONTEXT);
}

void forgetImages(Display& display) {
    detachImported(display);
    for (const auto& image : images().removeAll(display))
        retire(*image);
    const std::lock_guard lock(shown().mutex);
    shown().drop([&](const auto& image) { return &image->display == &display; });
}

EGLImageKHR EGLAPIENTRY createImageKhr(EGLDisplay dpy, EGLContext context, EGLenum target,
                                       EGLClientBuffer buffer, const EGLint* list) {
    if (isOfVg(context, target))
        return call(none, [&] { return createImage(dpy, context, target, buffer, list); });
    if (const auto systems = systemsExtension<decltype(createImageKhr)>(dpy, "eglCreateImageKHR")) {
        thisThread().error = EGL_SUCCESS;
        const EGLImage image = systems(dpy, context, target, buffer, list);
        importImage(dpy, image);
        return image;
    }
    return call(none, [&]() -> EGLImage {
        initializedDisplay(dpy);
        throw Error{EGL_BAD_PARAMETER};
    });
}

EGLBoolean EGLAPIENTRY destroyImageKhr(EGLDisplay dpy, EGLImageKHR image) {
    const auto systems = images().has(image)
                             ? nullptr
                             : systemsExtension<decltype(destroyImageKhr)>(dpy, "eglDestroyImageKHR");
    if (!systems)
        return destroyImage(dpy, image);
    thisThread().error = EGL_SUCCESS;
    forgetImported(dpy, image);
    return systems(dpy, image);
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLImage EGLAPIENTRY eglCreateImage(EGLDisplay dpy, EGLContext context, EGLenum target,
                                    EGLClientBuffer buffer, const EGLAttrib* list) {
    if (isOfVg(context, target))
        return call(none, [&] { return createImage(dpy, context, target, buffer, list); });
    const EGLImage image =
        forward(&System::CreateImage, none, EGL_BAD_PARAMETER, dpy, context, target, buffer, list);
    importImage(dpy, image);
    return image;
}

EGLBoolean EGLAPIENTRY eglDestroyImage(EGLDisplay dpy, EGLImage handle) {
    if (!images().has(handle)) {
        forgetImported(dpy, handle);
        return forward(&System::DestroyImage, EGLBoolean(EGL_FALSE), EGL_BAD_PARAMETER, dpy, handle);
    }
    return destroyImage(dpy, handle);
}

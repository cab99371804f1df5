// Section 3.9: EGLImages. Those of OpenVG's images are ours (EGL_KHR_image_base, EGL_KHR_vg_parent_image),
// all others the system's.

#include "api/egl/src/images.hpp"

#include "api/egl/src/attributes.hpp"
#include "api/egl/src/thread.hpp"

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

EGLBoolean destroyImage(EGLDisplay dpy, EGLImage handle) {
    return call(EGLBoolean(EGL_FALSE), [&] {
        const Display& display = initializedDisplay(dpy);
        const auto image = images().find(handle);
        require(image && &image->display == &display, EGL_BAD_PARAMETER);
        images().remove(handle);
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
    const auto image = std::make_shared<Image>(display, shared);
    images().add(image);
    if (!vtmNameSharedImage(shared, image->handle)) {
        images().remove(image->handle);
        throw Error{EGL_BAD_ALLOC};
    }
    return image->handle;
}

}  // namespace

EGLImageKHR EGLAPIENTRY createImageKhr(EGLDisplay dpy, EGLContext context, EGLenum target,
                                       EGLClientBuffer buffer, const EGLint* list) {
    if (isOfVg(context, target))
        return call(none, [&] { return createImage(dpy, context, target, buffer, list); });
    if (const auto systems = systemsExtension<decltype(createImageKhr)>(dpy, "eglCreateImageKHR")) {
        thisThread().error = EGL_SUCCESS;
        return systems(dpy, context, target, buffer, list);
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
    return systems(dpy, image);
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLImage EGLAPIENTRY eglCreateImage(EGLDisplay dpy, EGLContext context, EGLenum target,
                                    EGLClientBuffer buffer, const EGLAttrib* list) {
    if (isOfVg(context, target))
        return call(none, [&] { return createImage(dpy, context, target, buffer, list); });
    return forward(&System::CreateImage, none, EGL_BAD_PARAMETER, dpy, context, target, buffer, list);
}

EGLBoolean EGLAPIENTRY eglDestroyImage(EGLDisplay dpy, EGLImage handle) {
    if (!images().has(handle))
        return forward(&System::DestroyImage, EGLBoolean(EGL_FALSE), EGL_BAD_PARAMETER, dpy, handle);
    return destroyImage(dpy, handle);
}

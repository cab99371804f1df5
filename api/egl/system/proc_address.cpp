// Section 3.11: addresses of functions by their names.

#include <algorithm>
#include <array>
#include <string_view>

#include "api/egl/images/images.hpp"
#include "api/egl/state/displays.hpp"
#include "api/egl/state/thread.hpp"
#include "api/egl/surfaces/posting.hpp"
#include "api/egl/surfaces/surfaces.hpp"

namespace vtm::egl {

namespace {

using Function = __eglMustCastToProperFunctionPointerType;

struct Named {
    std::string_view name;
    Function function;
};

template <class F>
Function plain(F* function) {
    return reinterpret_cast<Function>(function);
}

#define VTM_EGL_NAMED(name) Named{"egl" #name, plain(&::egl##name)},
const std::array core{VTM_EGL_FUNCTIONS(VTM_EGL_NAMED)};
#undef VTM_EGL_NAMED

/// Functions of extensions that OpenVG has with any system, and without.
const std::array ofOpenVg{
    Named{"eglCreateImageKHR", plain(&createImageKhr)},
    Named{"eglDestroyImageKHR", plain(&destroyImageKhr)},
};

/// Functions of the system's extensions that may be given handles of ours.
const std::array extensions{
    Named{"eglGetPlatformDisplayEXT", plain(&getPlatformDisplayExt)},
    Named{"eglCreatePlatformWindowSurfaceEXT", plain(&createPlatformWindowSurfaceExt)},
    Named{"eglCreatePlatformPixmapSurfaceEXT", plain(&createPlatformPixmapSurfaceExt)},
    Named{"eglSwapBuffersWithDamageKHR", plain(&swapBuffersWithDamageKhr)},
    Named{"eglSwapBuffersWithDamageEXT", plain(&swapBuffersWithDamageExt)},
    Named{"eglSetDamageRegionKHR", plain(&setDamageRegionKhr)},
};

template <class List>
Function find(const List& list, std::string_view name) {
    const auto it = std::ranges::find(list, name, &Named::name);
    return it == list.end() ? nullptr : it->function;
}

}  // namespace

}  // namespace vtm::egl

using namespace vtm::egl;

__eglMustCastToProperFunctionPointerType EGLAPIENTRY eglGetProcAddress(const char* name) {
    // Those of OpenVG first: asking for them loads no system library, by which one of ours is told from
    // others.
    if (const auto function = name ? vtmGetProcAddress(name) : nullptr)
        return reinterpret_cast<Function>(function);
    if (const auto function = name ? find(core, name) : nullptr)
        return function;
    if (const auto function = name ? find(ofOpenVg, name) : nullptr)
        return function;
    if (!name || !systemEgl())
        return nullptr;
    thisThread().error = EGL_SUCCESS;
    const Function systems = systemEgl()->GetProcAddress(name);
    const Function ours = systems ? find(extensions, name) : nullptr;
    return ours ? ours : systems;
}

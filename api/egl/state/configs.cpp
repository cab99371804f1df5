// Section 3.4: the configs of OpenVG, and what all configs are asked for.

#include "api/egl/state/configs.hpp"

#include <algorithm>
#include <array>
#include <climits>

#include <vtm/egl.h>

#include "api/egl/state/thread.hpp"

namespace vtm::egl {

namespace {

constexpr VtmSurfaceFormat colorFormat(VGint red, VGint green, VGint blue, VGint alpha) {
    return {red, green, blue, alpha, 0, maskBits, VG_FALSE, VG_FALSE};
}
constexpr VtmSurfaceFormat greyFormat(VGint bits) { return {0, 0, 0, 0, bits, maskBits, VG_FALSE, VG_FALSE}; }

/// In the order of their IDs: all without multisampling, then all with it.
constexpr std::array formats{
    colorFormat(8, 8, 8, 8), colorFormat(8, 8, 8, 0), colorFormat(5, 6, 5, 0), colorFormat(5, 5, 5, 1),
    colorFormat(4, 4, 4, 4), colorFormat(0, 0, 0, 8), greyFormat(8),           greyFormat(1)};

constexpr std::array<EGLint, 2> sampleCounts{0, 4};

/// By themselves programs find the first.
constexpr std::array compositors{VTM_COMPOSITOR_AUTOMATIC, VTM_COMPOSITOR_CPU, VTM_COMPOSITOR_GL};

EGLint compositorAttribute(VtmCompositor compositor) {
    return compositor == VTM_COMPOSITOR_CPU  ? EGL_COMPOSITOR_CPU_VTM
           : compositor == VTM_COMPOSITOR_GL ? EGL_COMPOSITOR_GL_VTM
                                             : EGL_COMPOSITOR_AUTOMATIC_VTM;
}

/// The system's config, of those that show surfaces of type `surfaceBit`, that differs least from the format:
/// in bits of colour, then in bits of alpha, then by what it has besides. Null if there is none.
EGLConfig nearest(const Display& display, const std::vector<EGLConfig>& candidates, EGLint surfaceBit,
                  const VtmSurfaceFormat& format) {
    EGLConfig best = nullptr;
    int bestDistance = INT_MAX;
    const int wanted = format.redBits != 0 ? format.redBits : 8;
    for (const EGLConfig config : candidates) {
        const auto value = [&](EGLint name) { return systemConfigAttribute(display, config, name); };
        const bool isUsable = (value(EGL_SURFACE_TYPE) & surfaceBit) && value(EGL_SAMPLES) == 0 &&
                              (value(EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES2_BIT) && value(EGL_RED_SIZE) <= 8 &&
                              value(EGL_COLOR_BUFFER_TYPE) == EGL_RGB_BUFFER;
        if (!isUsable)
            continue;
        const int color = std::abs(value(EGL_RED_SIZE) - wanted),
                  alpha = std::abs(value(EGL_ALPHA_SIZE) - format.alphaBits);
        const int distance = (color * 16 + alpha) * 256 + value(EGL_DEPTH_SIZE) + value(EGL_STENCIL_SIZE);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = config;
        }
    }
    return best;
}

/// The system's config with just these colours, for pbuffers and all of `surfaceBits`; the nearest to 24 bits
/// of depth and 8 of stencil. Null if there is none.
EGLConfig equal(const Display& display, const std::vector<EGLConfig>& candidates, EGLint surfaceBits,
                const VtmSurfaceFormat& format) {
    EGLConfig best = nullptr;
    int bestDistance = INT_MAX;
    for (const EGLConfig config : candidates) {
        const auto value = [&](EGLint name) { return systemConfigAttribute(display, config, name); };
        const bool isEqual =
            value(EGL_RED_SIZE) == format.redBits && value(EGL_GREEN_SIZE) == format.greenBits &&
            value(EGL_BLUE_SIZE) == format.blueBits && value(EGL_ALPHA_SIZE) == format.alphaBits &&
            value(EGL_LUMINANCE_SIZE) == format.luminanceBits && format.redBits != 0 &&
            value(EGL_SAMPLES) == 0 && (value(EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES2_BIT) &&
            (value(EGL_SURFACE_TYPE) & surfaceBits) == surfaceBits;
        const int distance = std::abs(value(EGL_DEPTH_SIZE) - 24) + std::abs(value(EGL_STENCIL_SIZE) - 8);
        if (isEqual && distance < bestDistance) {
            bestDistance = distance;
            best = config;
        }
    }
    return best;
}

/// Finds by what surfaces of a config are shown, and by what OpenGL draws into them. OpenGL has samples of
/// its own, which nothing of ours can resolve.
void findSystems(Config& config, const std::vector<EGLConfig>& systems) {
    const Display& display = *config.display;
    config.window = nearest(display, systems, EGL_WINDOW_BIT, config.format);
    config.pixmap = nearest(display, systems, EGL_PIXMAP_BIT, config.format);
    if (config.samples == 0)
        config.gl =
            equal(display, systems, EGL_PBUFFER_BIT | (config.window ? EGL_WINDOW_BIT : 0), config.format);
    if (config.gl) {
        config.glApis = systemConfigAttribute(display, config.gl, EGL_RENDERABLE_TYPE);
        config.depthBits = systemConfigAttribute(display, config.gl, EGL_DEPTH_SIZE);
        config.stencilBits = systemConfigAttribute(display, config.gl, EGL_STENCIL_SIZE);
        if (config.window)
            config.window = config.gl;
    }
    if (config.window) {
        const auto value = [&](EGLint name) { return systemConfigAttribute(display, config.window, name); };
        config.visualId = value(EGL_NATIVE_VISUAL_ID);
        config.visualType = value(EGL_NATIVE_VISUAL_TYPE);
        config.minSwapInterval = value(EGL_MIN_SWAP_INTERVAL);
        config.maxSwapInterval = value(EGL_MAX_SWAP_INTERVAL);
    }
}

EGLint colorBits(const VtmSurfaceFormat& f) {
    return f.redBits + f.greenBits + f.blueBits + f.alphaBits + f.luminanceBits;
}

EGLint surfaceType(const Config& config) {
    return EGL_PBUFFER_BIT | EGL_SWAP_BEHAVIOR_PRESERVED_BIT | EGL_VG_COLORSPACE_LINEAR_BIT |
           EGL_VG_ALPHA_FORMAT_PRE_BIT | (config.window ? EGL_WINDOW_BIT : 0) |
           (config.pixmap ? EGL_PIXMAP_BIT : 0);
}

/// Pixels that are not bytes of red, green and blue are converted one by one, wherever they are shown or
/// mixed.
bool isSlow(const VtmSurfaceFormat& format) { return format.redBits != 8; }

}  // namespace

std::optional<EGLint> Config::attribute(EGLint name) const {
    switch (name) {
        case EGL_BUFFER_SIZE:
            return colorBits(format);
        case EGL_RED_SIZE:
            return format.redBits;
        case EGL_GREEN_SIZE:
            return format.greenBits;
        case EGL_BLUE_SIZE:
            return format.blueBits;
        case EGL_ALPHA_SIZE:
            return format.alphaBits;
        case EGL_LUMINANCE_SIZE:
            return format.luminanceBits;
        case EGL_ALPHA_MASK_SIZE:
            return format.maskBits;
        case EGL_COLOR_BUFFER_TYPE:
            return format.luminanceBits ? EGL_LUMINANCE_BUFFER : EGL_RGB_BUFFER;
        case EGL_CONFIG_CAVEAT:
            return isSlow(format) ? EGL_SLOW_CONFIG : EGL_NONE;
        case EGL_CONFIG_ID:
            return id;
        case EGL_CONFORMANT:
            // Shapes that complement each other leave a seam, as where there are no samples.
            if (samples != 0)
                return glApis;
            [[fallthrough]];
        case EGL_RENDERABLE_TYPE:
            return EGL_OPENVG_BIT | glApis;
        case EGL_SURFACE_TYPE:
            return surfaceType(*this);
        case EGL_MAX_PBUFFER_WIDTH:
        case EGL_MAX_PBUFFER_HEIGHT:
            return maxSide;
        case EGL_MAX_PBUFFER_PIXELS:
            return maxPixels;
        case EGL_MIN_SWAP_INTERVAL:
            return minSwapInterval;
        case EGL_MAX_SWAP_INTERVAL:
            return maxSwapInterval;
        case EGL_NATIVE_VISUAL_ID:
            return visualId;
        case EGL_NATIVE_VISUAL_TYPE:
            return visualType;
        case EGL_TRANSPARENT_TYPE:
            return EGL_NONE;
        case EGL_BIND_TO_TEXTURE_RGB:
        case EGL_BIND_TO_TEXTURE_RGBA:
        case EGL_NATIVE_RENDERABLE:
            return EGL_FALSE;
        case EGL_DEPTH_SIZE:
            return depthBits;
        case EGL_STENCIL_SIZE:
            return stencilBits;
        case EGL_COMPOSITOR_VTM:
            return compositorAttribute(compositor);
        case EGL_SAMPLE_BUFFERS:
            return samples != 0;
        case EGL_SAMPLES:
            return samples;
        case EGL_LEVEL:
        case EGL_TRANSPARENT_RED_VALUE:
        case EGL_TRANSPARENT_GREEN_VALUE:
        case EGL_TRANSPARENT_BLUE_VALUE:
            return 0;
        default:
            return std::nullopt;
    }
}

EGLint systemConfigAttribute(const Display& display, EGLConfig handle, EGLint name) {
    EGLint value = 0;
    if (!systemEgl()->GetConfigAttrib(display.handle, handle, name, &value))
        return 0;
    return name == EGL_RENDERABLE_TYPE || name == EGL_CONFORMANT ? value & ~EGL_OPENVG_BIT : value;
}

std::vector<EGLConfig> systemConfigs(const Display& display) {
    EGLint count = 0;
    if (!display.systemRuns || !systemEgl()->GetConfigs(display.handle, nullptr, 0, &count))
        return {};
    std::vector<EGLConfig> all(std::size_t(std::max(count, 0)));
    if (!systemEgl()->GetConfigs(display.handle, all.data(), count, &count))
        return {};
    all.resize(std::size_t(count));
    return all;
}

void makeConfigs(Display& display) {
    const std::vector<EGLConfig> systems = systemConfigs(display);
    EGLint lastId = 0;
    for (const EGLConfig config : systems)
        lastId = std::max(lastId, systemConfigAttribute(display, config, EGL_CONFIG_ID));
    std::vector<std::shared_ptr<const Config>> made;
    const auto add = [&](const VtmSurfaceFormat& format, EGLint samples, VtmCompositor compositor) {
        auto config = std::make_shared<Config>();
        config->display = &display;
        config->id = ++lastId;
        config->format = format;
        config->samples = samples;
        config->compositor = compositor;
        findSystems(*config, systems);
        configs().add(config);
        made.push_back(std::move(config));
    };
    for (const VtmCompositor compositor : compositors)
        for (const EGLint samples : sampleCounts)
            for (const VtmSurfaceFormat& format : formats)
                add(format, samples, compositor);
    display.configs = std::move(made);
}

}  // namespace vtm::egl

using namespace vtm::egl;

EGLBoolean EGLAPIENTRY eglGetConfigs(EGLDisplay dpy, EGLConfig* list, EGLint size, EGLint* count) {
    if (!findDisplay(dpy))
        return forward(&System::GetConfigs, EGLBoolean(EGL_FALSE), EGL_BAD_DISPLAY, dpy, list, size, count);
    return call(EGLBoolean(EGL_FALSE), [&] {
        Display& display = initializedDisplay(dpy);
        require(count != nullptr && (!list || size >= 0), EGL_BAD_PARAMETER);
        std::vector<EGLConfig> all = systemConfigs(display);
        {
            const std::lock_guard lock(display.initializing);
            // The others are found by what they are for: programs have room for so many configs.
            for (const auto& config : display.configs)
                if (config->compositor == VTM_COMPOSITOR_AUTOMATIC)
                    all.push_back(config->handle);
        }
        const EGLint total = EGLint(all.size());
        *count = list ? std::min(size, total) : total;
        if (list)
            std::copy_n(all.begin(), *count, list);
        return EGLBoolean(EGL_TRUE);
    });
}

EGLBoolean EGLAPIENTRY eglGetConfigAttrib(EGLDisplay dpy, EGLConfig handle, EGLint attribute, EGLint* value) {
    if (!configs().has(handle)) {
        const EGLBoolean isKnown = forward(&System::GetConfigAttrib, EGLBoolean(EGL_FALSE), EGL_BAD_CONFIG,
                                           dpy, handle, attribute, value);
        if (isKnown && value && (attribute == EGL_RENDERABLE_TYPE || attribute == EGL_CONFORMANT))
            *value &= ~EGL_OPENVG_BIT;
        return isKnown;
    }
    return call(EGLBoolean(EGL_FALSE), [&] {
        const auto config = getConfig(initializedDisplay(dpy), handle);
        const std::optional<EGLint> found = config->attribute(attribute);
        require(found.has_value(), EGL_BAD_ATTRIBUTE);
        require(value != nullptr, EGL_BAD_PARAMETER);
        *value = *found;
        return EGLBoolean(EGL_TRUE);
    });
}

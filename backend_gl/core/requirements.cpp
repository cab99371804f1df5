#include "backend_gl/core/requirements.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include <EGL/egl.h>
#include <fmt/format.h>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/tiles/block_grid.hpp"

namespace vtm::gl {

namespace {

/// Of GL_KHR_robustness, GL_EXT_robustness.
constexpr GLenum resetNotificationStrategy = 0x8256, loseContextOnReset = 0x8252;

struct Limit {
    GLenum name;
    const char* text;
    int minimum;
};
constexpr Limit limits[] = {
    {GL_MAX_TEXTURE_SIZE, "GL_MAX_TEXTURE_SIZE", 1 << texelColumnsLog2},
    {GL_MAX_TEXTURE_IMAGE_UNITS, "GL_MAX_TEXTURE_IMAGE_UNITS", int(unitCount)},
    {GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS, "GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS", int(unitCount)},
};

}  // namespace

void requireCurrentContext() {
    if (glGetString(GL_VERSION) == nullptr)
        throw GlError("no GL context is current");
}

void requireContext() {
    requireCurrentContext();
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    int major = 0;
    if (std::sscanf(version, "OpenGL ES %d", &major) != 1 || major < 3)
        throw GlError(fmt::format("the current context is '{}': OpenGL ES 3.0 or later is needed", version));
    dropErrors();
    for (const Limit& l : limits)
        if (limit(l.name) < l.minimum)
            throw GlError(
                fmt::format("the driver's {} is {}: {} is needed", l.text, limit(l.name), l.minimum));
    std::array<GLfloat, 2> pointSizes{};
    glGetFloatv(GL_ALIASED_POINT_SIZE_RANGE, pointSizes.data());
    if (pointSizes[1] < float(maxBlockSide))
        throw GlError(fmt::format("the driver's largest point has {} pixels: {} are needed", pointSizes[1],
                                  maxBlockSide));
}

std::function<unsigned()> driversResetStatus() {
    for (const auto& [extension, function] :
         {std::pair{"GL_KHR_robustness", "glGetGraphicsResetStatusKHR"},
          std::pair{"GL_EXT_robustness", "glGetGraphicsResetStatusEXT"}}) {
        const auto get = reinterpret_cast<GLenum (*)()>(eglGetProcAddress(function));
        if (get != nullptr && hasExtension(extension) &&
            GLenum(limit(resetNotificationStrategy)) == loseContextOnReset)
            return [get] { return unsigned(get()); };
    }
    return {};
}

}  // namespace vtm::gl

#include "gles_context/renderer_name.hpp"

#include <algorithm>
#include <span>

namespace vtm::gles_context {

namespace {

/// As GL_RENDERER begins or tells: Mesa's, ANGLE's, Apple's.
constexpr std::string_view softwareDrivers[] = {"llvmpipe", "LLVMPIPE",    "softpipe",
                                                "swrast",   "SwiftShader", "Software"};
constexpr std::string_view gpus[] = {"NVIDIA", "GeForce", "Quadro",  "Tegra", "AMD", "Radeon",    "Intel",
                                     "Mali",   "Adreno",  "PowerVR", "Apple", "V3D", "VideoCore", "Vivante"};

bool names(std::span<const std::string_view> drivers, std::string_view renderer) {
    return std::ranges::any_of(
        drivers, [&](std::string_view driver) { return renderer.find(driver) != std::string_view::npos; });
}

}  // namespace

std::optional<bool> isSoftwareName(std::string_view renderer) {
    if (names(softwareDrivers, renderer))
        return true;
    return names(gpus, renderer) ? std::optional(false) : std::nullopt;
}

}  // namespace vtm::gles_context

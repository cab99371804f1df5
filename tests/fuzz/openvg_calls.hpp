/// \file
/// Random programs of OpenVG calls: several contexts, shared and not, surfaces in memory and in images,
/// handles alive, dead and made up, arguments legal and not. Every function of VG/openvg.h, VG/vgu.h and
/// vtm/vg.h takes part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <vtm/vg.h>

namespace vtm::fuzz {

/// Makes calls as the bytes say until they end, then destroys all. Gives the number of calls.
std::size_t runOpenVgCalls(std::span<const std::uint8_t> bytes);

/// Pixels as vtmReadSurface gives them.
struct SurfacePicture {
    VGint width, height;
    VtmSurfaceFormat format;
    std::vector<std::uint8_t> pixels;
};
/// The same, with one compositor for all surfaces; gives what is on them in the end.
std::vector<SurfacePicture> drawnByOpenVgCalls(std::span<const std::uint8_t> bytes, VtmCompositor compositor);

}  // namespace vtm::fuzz

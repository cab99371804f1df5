/// \file
/// Blend modes (specification sections 13.2 to 13.6).
#pragma once

#include <span>

#include <VG/openvg.h>

#include "api/openvg/paint/color.hpp"

namespace vtm::openvg {

/// Source and destination, premultiplied in the same space, to what replaces the destination; channels in [0,
/// 1].
using Blend = Color (*)(Color source, Color destination);

struct BlendMode {
    Blend pixel;
    /// A row of pixels; `destination` is replaced.
    void (*row)(std::span<const Color> source, std::span<Color> destination);
};

/// Of a VGBlendMode or VGBlendModeKHR.
BlendMode blendModeOf(VGint mode);

/// The same, each colour channel with a source alpha of its own, as stencils have: `source` is premultiplied
/// by `alphas`, whose fourth number is the source's alpha.
Color blendChannels(Blend blend, Color source, Color alphas, Color destination);

}  // namespace vtm::openvg

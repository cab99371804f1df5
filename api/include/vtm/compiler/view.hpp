/// \file
/// Compiling for a raster: boundaries are within a sixteenth of a pixel at any zoom.
///
/// The accuracy of an asset is a share of its longer side (Options::tolerance), down to a provable 2^-24. If
/// a view needs more, the visible part is compiled on its own: it is moved to the origin, enlarged and
/// clipped in double precision, before anything is rounded.
#pragma once

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// A rectangle in user units. It may extend beyond the picture or lie outside it.
struct Part {
    double x = 0, y = 0, width = 0, height = 0;  ///< finite; width and height > 0
};

struct ViewResult {
    /// The result for the whole picture, or for the visible part and a small margin. Its lengths and
    /// positions are in the asset's space.
    Result result;
    /// The view that draws the part of this asset into the raster.
    asset::View view;
    /// Maps the scene to the asset's space: a scaling by powers of two and a translation. The identity if the
    /// whole picture was compiled.
    scene::Affine fromScene = scene::identity;
};

/// Max distance between the boundaries of a compiled view and the scene's, in pixels, unless a program asks
/// for another: along a straight edge a pixel is off by at most 4/255.
inline constexpr double viewShare = 1.0 / 64;

/// Compiles the asset for a frame (scene::frame). Options::tolerance is the coarsest tolerance used; it is
/// reduced to `share` of a pixel's shorter side where it is larger than that. Asset::finestPixel says
/// what was reached. result.warnings says if the goal was missed, which happens beyond a magnification of
/// about 10^11, where the rounding of the scene's own doubles shows. Images with ImageFilter::Nearest and
/// materials are drawn in single precision and do not become finer. Throws as compile does, std::length_error
/// if the raster exceeds asset::maxViewSide or maxViewPixels, and std::invalid_argument if a number of the
/// frame is not finite or a pixel's size is not above 0.
ViewResult compileView(const scene::Scene& scene, const scene::Frame& frame, const Options& options = {},
                       double share = viewShare);

/// The same for a raster of `width` by `height` pixels that `part` fills. Also throws std::invalid_argument
/// if the raster is empty or `part` violates the ranges above.
ViewResult compileView(const scene::Scene& scene, const Part& part, int width, int height,
                       const Options& options = {});

/// Returns the frame's view of an asset of the whole picture. Throws std::length_error if the raster or a
/// number exceeds the limits in vtm/raster/view.hpp.
asset::View viewOf(const scene::Frame& frame);

}  // namespace vtm::compiler

#pragma GCC visibility pop

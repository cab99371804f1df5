/// \file
/// Compiling for a raster: boundaries within a sixteenth of a pixel, at any zoom.
///
/// An asset is as fine as a share of its longer side (Options::tolerance), of which 2^-24 can be proven.
/// Where a view wants more than the whole picture is compiled with, the part that it shows is compiled for
/// itself: scenes are doubles, so the part is moved to the origin, enlarged and cut out before anything is
/// rounded.
#pragma once

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/affine.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// A rectangle in user units. It may reach beyond the picture, or lie outside.
struct Part {
    double x = 0, y = 0, width = 0, height = 0;  ///< finite; width and height > 0
};

struct ViewResult {
    /// Of the whole picture, or of what the view shows of it and a little more. Lengths and places in it are
    /// those of the asset's space.
    Result result;
    /// Draws the part into the raster from this asset.
    asset::View view;
    /// From the scene to the asset's space: scales by powers of two and moves. The identity for whole
    /// pictures.
    scene::Affine fromScene = scene::identity;
};

/// The asset for a frame (scene::frame). Options::tolerance is the coarsest
/// that is used; where that is not a sixteenth of a pixel's shorter side, it is made so. Asset::finestPixel
/// says what was reached, and result.warnings where it was not: beyond some 10^11 times, when roundings of
/// the scene's own doubles show. Not made finer by it: images with ImageFilter::Nearest and materials, which
/// are drawn from single precision. Throws as compile does; std::length_error where the raster is beyond
/// asset::maxViewSide or maxViewPixels, std::invalid_argument where a number of the frame is not finite or
/// its pixels are not above 0.
ViewResult compileView(const scene::Scene& scene, const scene::Frame& frame, const Options& options = {});

/// The same for a raster of `width` by `height` pixels that `part` fills; std::invalid_argument where it is
/// empty or `part` is not as above.
ViewResult compileView(const scene::Scene& scene, const Part& part, int width, int height,
                       const Options& options = {});

/// The frame's view of an asset of the whole picture. Throws std::length_error where the raster or a number
/// is beyond the limits of vtm/raster/view.hpp.
asset::View viewOf(const scene::Frame& frame);

}  // namespace vtm::compiler

#pragma GCC visibility pop

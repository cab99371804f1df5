/// \file
/// The exact CPU reference: double precision, no code in common with the compiler, only the scene's
/// types. Slow and sure.
#pragma once

#include "image/bitmap.hpp"
#include "scene/scene.hpp"

namespace vtm::reference {

/// A raster and the map from picture to pixel coordinates (pixel (i, j) is [i, i+1] × [j, j+1]).
struct View {
    int width = 0, height = 0;
    scene::Affine toPixels = scene::identity;
};

/// Share of each pixel's box that a path covers, exactly for polygons and, for curves, within
/// `flatness` pixels of the true outline: width * height doubles, rows top to bottom.
std::vector<double> fillCoverage(const scene::Path& path, const scene::Affine& transform, scene::FillRule rule,
                                 const View& view, double flatness = 1e-4);
/// The same for a stroke.
std::vector<double> strokeCoverage(const scene::Path& path, const scene::Affine& transform,
                                   const scene::StrokeStyle& style, const View& view, double flatness = 1e-4);

enum class Mode { Exact, Compat };

struct Options {
    Mode mode = Mode::Exact;
    int samples = 32;  ///< a side of the pixel, exact mode; in [1, 256]
};

/// The scene on transparent black. Exact: mean of the composited colour over samples × samples
/// points a pixel. Compat: each layer's exact coverage times its paint, `over`, layer by layer.
image::Raster render(const scene::Scene& scene, const View& view, const Options& options = {});

}  // namespace vtm::reference

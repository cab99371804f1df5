/// \file
/// The exact CPU reference: double precision, no code in common with the compiler, only the scene's
/// types. Slow and sure.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec4.hpp>

#include <vtm/image/bitmap.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::reference {

inline constexpr int maxViewSide = 16384;
inline constexpr std::int64_t maxViewPixels = std::int64_t(1) << 27;
/// A path whose dash pattern puts more dashes than this into the view is stroked solid.
inline constexpr std::int64_t maxDashes = 1'000'000;

/// A raster and the map from picture to pixel coordinates (pixel (i, j) is [i, i+1] × [j, j+1]). Every
/// function throws std::length_error beyond the limits above and std::invalid_argument if a side is
/// not positive.
struct View {
    int width = 0, height = 0;
    scene::Affine toPixels = scene::identity;
};

/// Share of each pixel's box that a path covers, exactly for polygons and, for curves, within
/// `flatness` pixels of the true outline: width * height doubles, rows top to bottom.
std::vector<double> fillCoverage(const scene::Path& path, const scene::Affine& transform,
                                 scene::FillRule rule, const View& view, double flatness = 1e-4);
/// The same for a stroke.
std::vector<double> strokeCoverage(const scene::Path& path, const scene::Affine& transform,
                                   const scene::StrokeStyle& style, const View& view, double flatness = 1e-4);
/// How many edges it measures in the view; where all run through one pixel, the time grows with their cube.
std::size_t strokeEdges(const scene::Path& path, const scene::Affine& transform,
                        const scene::StrokeStyle& style, const View& view, double flatness = 1e-4);

enum class Mode { Exact, Compat };

/// The premultiplied colour of a material at point p of its own space.
using MaterialFunction = std::function<glm::dvec4(const scene::Material& material, scene::Point p)>;

struct Options {
    Mode mode = Mode::Exact;
    /// Parts a side of a pixel, in [1, 256], in which paints that vary are read where few do not do:
    /// gradients by their mean over each, patterns and images at its middle. Solid colours need none, and
    /// trilinear and bicubic images have one colour a pixel, for its centre.
    int samples = 32;
    /// Curves lie within it of the true outlines, in pixels, > 0: half a 255th of a pixel's colour takes 2e-3
    /// along a whole side of it.
    double flatness = 1e-4;
    /// Draws materials, from several threads at once; without it they have their fallback colours.
    MaterialFunction materials = {};
};

/// The scene on transparent black. Exact: the mean of the composited colour over the pixel's box,
/// weighted by the exact areas of the regions that outlines cut it into. Compat: each layer's exact
/// coverage times its paint's mean over the pixel (images: at its centre), `over`, layer by layer. The scene
/// is valid. Throws std::invalid_argument if `samples` or `flatness` is out of range.
image::Raster render(const scene::Scene& scene, const View& view, const Options& options = {});

}  // namespace vtm::reference

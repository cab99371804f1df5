/// \file
/// Views of pictures as textures: turned, stretched, as a floor up to the horizon, zoomed.
#pragma once

#include <functional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::cases {

/// The picture, its longer side `pixels` long, in the middle of a square raster, turned.
asset::View turned(glm::dvec2 picture, int raster, double pixels, double angle);

/// ... its width `pixels` long before it is turned and then shrunk by `ratio` along the raster's direction
/// `axis`, an angle: every pixel's footprint is `ratio` times as long as wide.
asset::View stretched(glm::dvec2 picture, int raster, double pixels, double ratio, double angle, double axis);

/// A plane seen at a low angle; one picture is as wide as the raster's lowest row, nearly.
struct Floor {
    int width, height;
    double ratio;    ///< of the footprints' sides in the top row, where it is largest
    double horizon;  ///< pixels above the raster

    /// (pixel, 1) to homogeneous (s, t), for a raster `samples` times as large.
    glm::dmat3 toPicture(int samples) const;
};
inline constexpr Floor mildFloor{192, 96, 4, 32}, steepFloor{192, 96, 16, 12};

/// The mean of a picture over each pixel, by the CPU evaluator: exact for solid paints. Where the asset has
/// paint programs, which the evaluator looks at once a pixel, on a grid four times finer.
image::Raster exactMeans(const asset::Asset& asset, const asset::View& view);
bool hasPrograms(const asset::Asset& asset);

/// Means of k × k pixels.
image::Raster averaged(const image::Raster& raster, int k);

struct ZoomFrame {
    double pixels;    ///< the picture's longer side
    double error;     ///< rms against the exact picture, in 1/255
    double contrast;  ///< between the exact picture's lightest and darkest pixel, of 1
    double change;    ///< rms of what the error changes from the frame before, registered, in 1/255
};

using Draw = std::function<image::Raster(const asset::View&)>;

/// From 16 to 65536 pixels in steps of an eighth of an octave, into a point on an outline.
std::vector<ZoomFrame> zoomed(glm::dvec2 picture, const Draw& texture, const Draw& exact);

}  // namespace vtm::cases

/// \file
/// The raster of a filter under a view, and which pixels of it are needed.
///
/// A filter works on a raster whose axes are those of its user space, as fine as the view's. If they are the
/// view's axes too, up to turns by 90° and mirroring, its pixels are pixels of the view. Else its result is
/// sampled for the view, as every image is.
#pragma once

#include <limits>
#include <vector>

#include <glm/mat3x2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/pixel_box.hpp>
#include <vtm/raster/view.hpp>
#include "asset/filters.hpp"

namespace vtm::asset {

/// A rectangle of a filter's raster.
struct PixelRect {
    glm::dvec2 min{0}, max{0};

    /// The pixels that it meets.
    PixelBox pixels() const;
};

struct FilterPlace {
    glm::dvec2 scale{1}, origin{0};          ///< pixel = scale · point of the user space + origin
    glm::dmat3x2 toBelow{1, 0, 0, 1, 0, 0};  ///< to pixels of the picture below
    bool isSampled = false;                  ///< else toBelow maps pixels to pixels
    glm::dmat3x2 pictureToRaster{1, 0, 0, 1, 0, 0};
    PixelRect region;                ///< of the filter
    std::vector<PixelRect> regions;  ///< of the primitives, within it
    std::vector<PixelBox> needed;    ///< of the primitives' results
    std::vector<PixelBox> pictures;  ///< of the pictures that are pushed for it
    bool inWholePixels = false;      ///< regions and offsets, as other renderers have it (compat mode)
    PixelBox shown;                  ///< of its result, for the picture below

    /// The raster of one of the pictures.
    View viewOf(std::size_t picture) const;
};

/// Under the view of the picture below. The raster is coarser where a layer would have more pixels along a
/// side than `maxSide`, or more than 2^24.
FilterPlace placeOf(const AssetView& asset, const Filter& filter, const View& below,
                    int maxSide = std::numeric_limits<int>::max());

/// Whole pixels round the mapped box.
PixelBox mapped(const PixelBox& box, const glm::dmat3x2& map);

/// Where inputs are read: 0 and 1 stand for the first picture.
inline std::size_t resultOf(std::uint32_t input) { return input - firstResult; }

}  // namespace vtm::asset

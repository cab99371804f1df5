/// \file
/// The squares of one cut under one view: which of them a box of pixels can meet, and where they lie.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/view.hpp>
#include "backend_gl/core/placement.hpp"
#include "backend_gl/tiles/atlas.hpp"
#include "backend_gl/tiles/block_grid.hpp"

namespace vtm::gl {

class TileRaster {
public:
    /// `view` is invertible and must outlive it.
    TileRaster(const asset::Map& map, const asset::View& view, const PixelBox& box, int level,
               int largestBlock);

    glm::dvec2 toPicture(glm::dvec2 tile) const { return corner_ + side_ * tile; }
    glm::dvec2 toPixel(glm::dvec2 tile) const { return view_->toPixels * glm::dvec3(toPicture(tile), 1); }
    glm::dvec2 toTile(glm::dvec2 pixel) const {
        return (inverse_ * (pixel - view_->toPixels[2]) - corner_) / side_;
    }
    /// Of distances.
    glm::dmat2 pixelsToTiles() const { return inverse_ / side_; }
    double side() const { return side_; }  ///< picture units
    const asset::View& view() const { return *view_; }
    const PixelBox& box() const { return box_; }
    /// Paints that change by more are steep in the view.
    float minSteepness() const { return minSteepness_; }
    /// The tiles that pixels of the box lie in.
    const Atlas::Region& region() const { return region_; }
    /// How the view is drawn.
    const BlockGrid& grid() const { return grid_; }

private:
    double side_;
    glm::dvec2 corner_;
    const asset::View* view_;
    PixelBox box_;
    glm::dmat2 inverse_;
    float minSteepness_;
    Atlas::Region region_;
    BlockGrid grid_;
};

}  // namespace vtm::gl

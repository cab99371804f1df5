/// \file
/// A pattern fill in, an image of what it shows out: for patterns of more tiles than can be made one by one
/// or placed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/bitmap.hpp>
#include "compiler/lower/lower.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {

/// Tiles that are lowered one by one; what needs more is an image.
struct TileLimits {
    double ofFill = maxTiles, ofAll = 10 * maxTiles;  ///< of one fill, of all fills
};

/// Tiles that have been drawn. Those of patterns in patterns are drawn once, or once by each of the threads
/// that ask for them at one time, however often they are asked for.
class DrawnTiles {
public:
    /// So many pixels.
    std::shared_ptr<const image::Raster> tile(const scene::Pattern& pattern, glm::ivec2 size,
                                              const Options& options);

private:
    struct Tile {
        scene::Link<scene::Group> content;  ///< kept, so that no other has its address
        scene::Point min, max;
        std::shared_ptr<const image::Raster> pixels;
        glm::ivec2 size;
    };
    std::shared_ptr<const image::Raster> find(const scene::Pattern& pattern, glm::ivec2 size);

    std::mutex mutex_;  ///< guards `tiles_`
    std::vector<Tile> tiles_;
};

class PatternImages {
public:
    /// For a picture whose longer side is so many units. `outer`: of a tile that is drawn, whose units are
    /// pixels; null for others.
    PatternImages(const Options& options, double longerSide, DrawnTiles* outer);

    TileLimits limits() const;

    /// An image paint in the picture's space, right at least in `seen`; nothing if all images together would
    /// have too many pixels. Other fills of the pattern, moved or not, share it where it shows what they
    /// need; `most`: what they may need.
    std::optional<scene::ImagePaint> paint(const scene::Pattern& pattern, const scene::Affine& toPicture,
                                           const geometry::Box& seen, const geometry::Box& most);

private:
    struct Drawn {
        scene::Pattern pattern;
        scene::Affine toPicture;
        geometry::Box box;  ///< that the image shows
        scene::ImagePaint paint;
    };

    std::optional<Drawn> drawn(const scene::Pattern& pattern, const scene::Affine& toPicture,
                               geometry::Box box);

    const Options options_;
    DrawnTiles own_;
    DrawnTiles& tiles_;
    const double scale_;  ///< pixels per unit
    double pixels_ = 0;   ///< of all images
    std::vector<Drawn> drawn_;
};

}  // namespace vtm::compiler

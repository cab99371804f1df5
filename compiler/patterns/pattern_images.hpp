/// \file
/// A pattern fill in, an image of what it shows out: for patterns of more tiles than can be made one by one
/// or placed.
#pragma once

#include <optional>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include "compiler/lower/lower.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {

/// Tiles that are lowered one by one; what needs more is an image.
struct TileLimits {
    double ofFill = maxTiles, ofAll = 10 * maxTiles;  ///< of one fill, of all fills
};

class PatternImages {
public:
    /// For a picture whose longer side is so many units.
    PatternImages(const Options& options, double longerSide);

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
    const double scale_;  ///< pixels per unit
    double pixels_ = 0;   ///< of all images
    std::vector<Drawn> drawn_;
};

}  // namespace vtm::compiler

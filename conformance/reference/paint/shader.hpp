/// \file
/// Paints as functions from a point of the raster to a colour.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <vtm/scene/paint.hpp>
#include "conformance/reference/outline/geometry.hpp"
#include "conformance/reference/paint/blend.hpp"
#include "conformance/reference/paint/ramp.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::reference {

struct FlatScene;

/// What a paint is asked for: a rectangle of the raster.
struct Spot {
    Point centre;
    Vector size{0};  ///< 0: a point
};

struct SolidShader {
    Colour colour;

    Colour at(Point) const { return colour; }
};

struct LinearShader {
    Affine toPaint;
    Point start;
    Vector gradient;  ///< of the offset
    Ramp ramp;

    /// The mean over the spot.
    Colour over(const Spot& spot) const;
};

/// Circles about focus + t·(center - focus) of radius focalRadius + t·(radius - focalRadius).
struct RadialShader {
    Affine toPaint;
    scene::RadialGradient gradient;
    Ramp ramp;

    /// The mean over the spot, as if the offset were a straight line there.
    Colour over(const Spot& spot) const;
    /// The largest t whose circle passes through a point of paint space and has a radius.
    std::optional<double> offsetAt(Point p) const;
};

/// Means over 2^l × 2^l pixels of a bitmap, l = 1, 2 ... as far as they are asked for; in doubles.
class Means {
public:
    Means(const image::Bitmap& bitmap, double footprint);
    /// Of a square so many texels wide on level l >= 1 or the last.
    Colour at(int l, Point p, double width) const;

private:
    struct Level {
        int width, height;
        double side;  ///< of a texel, pixels
        std::vector<Colour> texels;
    };
    std::vector<Level> levels_;
};

struct ImageShader {
    ImageShader(const Affine& toPaint, const scene::ImagePaint& paint);

    /// Trilinear and bicubic: a colour for the pixel of which p is the centre.
    bool isOfAPixel() const { return filter >= scene::ImageFilter::Trilinear; }
    Colour at(Point p) const;

    Affine toPaint;
    std::shared_ptr<const image::Bitmap> bitmap;
    scene::ImageFilter filter;
    double width;  ///< of the squares that a pixel of the raster is read in, in the bitmap
    double ratio;  ///< of the pixel's longer axis to that, at least 1
    Vector along;  ///< the longer axis' direction
    std::shared_ptr<const Means> means;  ///< where they are wider than one
};

struct MaterialShader {
    Affine toPaint;
    scene::Material material;
    MaterialFunction function;  ///< not empty

    Colour at(Point p) const { return function(material, scene::apply(toPaint, p)); }
};

/// A pattern: `tile` shows one period, `tileSize` of its pixels wide and high.
struct TileShader {
    Affine toTile;  ///< from the raster to the first tile's pixels
    Vector tileSize;
    std::shared_ptr<const FlatScene> tile;

    /// Where in the tile a point of the raster falls.
    Point wrapped(Point p) const;
};

using Shader = std::variant<SolidShader, LinearShader, RadialShader, ImageShader, MaterialShader, TileShader>;

}  // namespace vtm::reference

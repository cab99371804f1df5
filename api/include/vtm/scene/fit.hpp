/// \file
/// Computes which part of a picture is visible, in how many pixels, and how it is fitted into them. The
/// importer's viewports and the command use it, and so can programs that draw into rectangles of their own.
#pragma once

#include <optional>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>

#pragma GCC visibility push(default)

namespace vtm::scene {

/// A rectangle with its min corner at (x, y), y downwards; in user units or pixels.
struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
};

/// How content is fitted into a viewport of another aspect. The names are those of CSS object-fit; SVG's are
/// in brackets.
enum class Fit {
    Contain,  ///< the whole content is visible; parts of the viewport may be empty (meet)
    Cover,    ///< the whole viewport is covered; parts of the content may be outside (slice)
    Stretch   ///< the content fills the viewport; its aspect ratio is not kept (none)
};

/// SVG's preserveAspectRatio (SVG 2 section 8.8); the default is its xMidYMid meet.
struct Placement {
    Fit fit = Fit::Contain;
    /// The share of the free space that is left of the content, and above it: 0 Min, 0.5 Mid, 1 Max.
    double alignX = 0.5, alignY = 0.5;
};

/// Returns the rectangle of content of the given size in the viewport. All sizes must be above 0.
Rect fittedRect(double contentWidth, double contentHeight, const Placement& placement, const Rect& viewport);

/// Maps `content` to its place in the viewport.
Affine fittedMap(const Rect& content, const Placement& placement, const Rect& viewport);

/// A requested view of a picture. With neither width nor height a user unit is `scale` pixels; with one of
/// them the other follows from the aspect ratio; with both the placement applies.
struct Framing {
    std::optional<int> width = {}, height = {};  ///< pixels, above 0
    double scale = 1;                            ///< finite, above 0
    /// The visible part in user units, not empty; may extend beyond the picture. By default the whole
    /// picture.
    std::optional<Rect> part = {};
    double rotation = 0;       ///< degrees, clockwise; the bounds of the rotated part are framed
    Placement placement = {};  ///< of these bounds, if width and height are given
};

/// The raster's size and the part of the picture that it shows. The factors of the map are separate, not one
/// matrix, so that deep zooms lose no precision.
struct Frame {
    double width = 1, height = 1;  ///< whole numbers above 0; engines have limits (vtm/raster/view.hpp)
    Point pixel{1, 1};             ///< a pixel's width and height, in rotated user units
    Point turn{1, 0};              ///< cosine and sine of the rotation
    Point origin{0, 0};            ///< a point in user units
    Point originPixel{0, 0};       ///< the same point in pixels

    bool isTurned() const { return turn != Point(1, 0); }
    /// Returns the map from user units to pixels; pixel (i, j) is the box [i, i+1] × [j, j+1].
    Affine toPixels() const;
    /// Returns the map to pixels from a space with its origin at `from`, in user units, in which a user unit
    /// has the size `scale`.
    Affine toPixels(Point from, Point scale) const;
    /// Returns the bounds of the raster in user units.
    Rect seen() const;
};

/// Returns the frame for a request. A side of the raster that is not given is rounded to at least one pixel;
/// the part then fills the raster. Where the placement leaves free space, the picture beside the part is
/// visible. The picture's sizes must be above 0.
Frame frame(const Framing& framing, double pictureWidth, double pictureHeight);

}  // namespace vtm::scene

#pragma GCC visibility pop

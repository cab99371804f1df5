/// \file
/// Which part of a picture is shown, in how many pixels, and how it is fitted into them. The one place that
/// decides this: the importer's viewports, the command and programs that draw into rectangles of their own
/// use it.
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
    Contain,  ///< all of the content is seen, some of the viewport may be empty (meet)
    Cover,    ///< no viewport is left empty, some of the content may lie outside (slice)
    Stretch   ///< content and viewport end at the same edges, the aspect is not kept (none)
};

/// SVG's preserveAspectRatio (SVG 2 section 8.8); the default is its xMidYMid meet.
struct Placement {
    Fit fit = Fit::Contain;
    /// Which share of the free space lies left of the content and above it: 0 Min, 0.5 Mid, 1 Max.
    double alignX = 0.5, alignY = 0.5;
};

/// Returns the rectangle of content of the given size in the viewport. All sizes must be above 0.
Rect fittedRect(double contentWidth, double contentHeight, const Placement& placement, const Rect& viewport);

/// Maps `content` to its place in the viewport.
Affine fittedMap(const Rect& content, const Placement& placement, const Rect& viewport);

/// What is wanted of a picture. With neither width nor height a user unit is `scale` pixels; with one of them
/// the other follows from the aspect; with both the placement decides.
struct Framing {
    std::optional<int> width = {}, height = {};  ///< pixels, above 0
    double scale = 1;                            ///< finite, above 0
    /// User units, not empty; may reach beyond the picture. The whole picture where there is none.
    std::optional<Rect> part = {};
    double rotation = 0;       ///< degrees, clockwise; what is framed are the part's bounds after it
    Placement placement = {};  ///< of these bounds, where width and height are given
};

/// A raster and what it shows. The numbers are kept apart, instead of as one matrix, so that deep zooms lose
/// nothing.
struct Frame {
    double width = 1, height = 1;  ///< whole numbers above 0; engines have limits (vtm/raster/view.hpp)
    Point pixel{1, 1};             ///< a pixel's width and height, in turned user units
    Point turn{1, 0};              ///< cosine and sine of the rotation
    Point origin{0, 0};            ///< a point in user units
    Point originPixel{0, 0};       ///< where the raster shows it

    bool isTurned() const { return turn != Point(1, 0); }
    /// From user units to pixels: pixel (i, j) is the box [i, i+1] × [j, j+1].
    Affine toPixels() const;
    /// To pixels from a space whose origin is `from`, in user units, and where `scale` is the size of a user
    /// unit.
    Affine toPixels(Point from, Point scale) const;
    /// Bounds, in user units, of the box of pixels.
    Rect seen() const;
};

/// A side of the raster that is not given is rounded, and at least one pixel; the part then fills the raster.
/// What lies beside the part is shown where the placement leaves room for it. The picture's sizes must be
/// above 0.
Frame frame(const Framing& framing, double pictureWidth, double pictureHeight);

}  // namespace vtm::scene

#pragma GCC visibility pop

/// \file
/// The target of a drawing and its colour encoding (docs/backend.md).
#pragma once

#include <optional>
#include <vector>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// Pixels [x, x + width) × [y, y + height).
struct PixelRectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

struct Output {
    /// A framebuffer object, or 0 for the window's; empty: the one bound for drawing. Its first draw buffer
    /// may have any normalised or float format and any number of samples per pixel.
    std::optional<unsigned> framebuffer;

    /// The corner of the view's rectangle in GL's pixel coordinates (y upwards in a window). Parts outside
    /// the framebuffer are not drawn.
    int x = 0, y = 0;

    enum class FirstRow {
        Bottom,  ///< the view's row 0 is GL's: the first of a texture, the lowest of a window
        Top      ///< upright in a window
    } firstRow = FirstRow::Bottom;

    enum class Alpha { Premultiplied, Straight } alpha = Alpha::Premultiplied;

    /// Ignored for sRGB formats: they are written with linear light, which GL encodes.
    enum class Encoding { Srgb, Linear } encoding = Encoding::Srgb;

    enum class Write {
        Replace,  ///< transparent where the picture is
        Over      ///< blended over the target's content in its own encoding; premultiplied only
    } write = Write::Replace;

    /// If set, only these pixels of the view change; the rectangles may overlap. Empty: the whole view.
    std::optional<std::vector<PixelRectangle>> damage;

    /// Ordered dithering by less than half a step of an 8-bit target; representable colours do not change.
    /// Other targets are not dithered.
    bool dither = false;

    /// Whether coverage is accumulated in linear light instead of sRGB-encoded colour (exact mode only).
    bool linearLight = false;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

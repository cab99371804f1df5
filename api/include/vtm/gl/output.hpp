/// \file
/// Where a picture is drawn and in which numbers (docs/backend.md).
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
    /// A framebuffer object, or 0, the window's; nothing: the one that is bound for drawing. Its first draw
    /// buffer is drawn into: of any normalised or float format, with one sample a pixel or several.
    std::optional<unsigned> framebuffer;

    /// The view's rectangle of pixels begins here: GL's coordinates, y upwards in a window. What lies outside
    /// the framebuffer is not drawn.
    int x = 0, y = 0;

    enum class FirstRow {
        Bottom,  ///< the view's row 0 is GL's: the first of a texture, the lowest of a window
        Top      ///< upright in a window
    } firstRow = FirstRow::Bottom;

    enum class Alpha { Premultiplied, Straight } alpha = Alpha::Premultiplied;

    /// Into sRGB formats goes linear light whatever is said here: GL encodes it on its way.
    enum class Encoding { Srgb, Linear } encoding = Encoding::Srgb;

    enum class Write {
        Replace,  ///< transparent where the picture is
        Over      ///< blended over what is there, in the target's numbers; premultiplied only
    } write = Write::Replace;

    /// Nothing: the whole view. Else only these pixels of the view change; they may overlap.
    std::optional<std::vector<PixelRectangle>> damage;

    /// Ordered, by less than half a step of an 8-bit target; colours that it can hold stay as they are. Other
    /// targets are not dithered.
    bool dither = false;

    /// Whether the shares of regions in a pixel are added in linear light instead of encoded (exact mode
    /// only).
    bool linearLight = false;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

/// \file
/// One mask of the paper mode repeated over the plane: the paper's row 11, with filter and compression each
/// on or off.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <vtm/gl/context.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "paper/gl/programs.hpp"
#include "paper/gl/surface.hpp"
#include "paper/model.hpp"

namespace vtm::paper {

struct PatternForm {
    bool compressed =
        true;  ///< row 8: a 16-tree of one depth; else a grid of its finest squares, each with its cell
    bool filtered = true;  ///< rows 6 and 7; else each pixel is what its centre is
    bool linear = false;   ///< slopes are taken as 0 (row 10's cheaper form)
};

/// The fragment shader of a tree or grid of so many levels (at least 1), GLSL ES 3.00: what is counted for
/// rows 9 and
/// 10. Filtered, it is the one that reads both the cells and the mip.
std::string patternShader(PatternForm form, unsigned depth, Shown shown = Shown::View);

/// Needs a current context for its whole life, in any state, and leaves that as it was.
class Pattern {
public:
    /// `mask` must be valid. Throws GlError where the grid is larger than a texture may be.
    Pattern(const Mask& mask, PatternForm form);
    ~Pattern();
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;

    /// Texels of its textures, the mip's too.
    std::size_t bytes() const;

    /// Draws into 8 bits a channel of a target of its own and waits for it. The view maps the plane of
    /// periods, in which the mask fills [0, 1] × [0, 1], to pixels.
    void draw(const asset::View& view);
    /// ... and reads it back: the coverage in all four channels.
    image::Raster render(const asset::View& view);

    /// The same over a surface. The level of the mip is each pixel's own, from the derivatives of (s, t), and
    /// two levels are blended (row 7). Throws std::length_error where a side of the raster is not in
    /// [1, asset::maxViewSide].
    void draw(const UploadedSurface& surface, glm::ivec2 size);
    image::Raster render(const UploadedSurface& surface, glm::ivec2 size);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::paper

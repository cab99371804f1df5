/// \file
/// What an Output means for one view: where it lies in the framebuffer, which pixels change, in which
/// numbers.
#pragma once

#include <vector>

#include <vtm/gl/output.hpp>
#include <vtm/raster/view.hpp>
#include "backend_gl/core/features.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"

namespace vtm::gl {

struct Destination {
    GLuint framebuffer = 0;
    bool multisampled = false;
    int bits = 0;  ///< a channel; 0: floats
    bool over = false;
    Finish finish;
    /// To the framebuffer's pixels; its raster is [0, width) × [0, height) of them.
    asset::View view;
    /// Where the view's own rectangle begins, and its rows, from the framebuffer's.
    glm::ivec2 corner{0};
    int rows = 0;
    bool isTopFirst = false;
    int rowOf(int y) const { return isTopFirst ? corner.y + rows - 1 - y : y - corner.y; }
    /// Disjoint, in the framebuffer, none empty.
    std::vector<PixelBox> boxes;
};

/// Leaves the framebuffer bound for drawing. `bound`: the one where `output` names none. Throws GlError for a
/// framebuffer that cannot be drawn into so, std::invalid_argument for an Output that contradicts itself.
Destination destinationOf(const asset::View& view, const Output& output, GLuint bound);

/// The pixels of `boxes` in boxes that do not overlap.
std::vector<PixelBox> disjoint(const std::vector<PixelBox>& boxes);

/// Only the first draw buffer of the framebuffer that is bound for drawing gets fragments while this lives:
/// our shaders have one colour, and what the others would get is undefined.
class OneDrawBuffer {
public:
    OneDrawBuffer();
    ~OneDrawBuffer();
    OneDrawBuffer(const OneDrawBuffer&) = delete;
    OneDrawBuffer& operator=(const OneDrawBuffer&) = delete;

private:
    GLuint framebuffer_;
    std::vector<GLenum> buffers_;  ///< empty: there was no other
};

}  // namespace vtm::gl

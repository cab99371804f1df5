/// \file
/// Finished pictures into a user's framebuffer.
#pragma once

#include <cstdint>
#include <vector>

#include "backend_gl/layers/layer_renderer.hpp"
#include "backend_gl/output/destination.hpp"

namespace vtm::gl {

/// From here on the box of the destination, which is cleared unless what is drawn goes over it, and nothing
/// else is drawn into.
void begin(const Destination& destination, const PixelBox& box);
/// After one begin() or several.
void end();

/// Draws a target's pixels into a box that has begun; `toTarget` leads from the framebuffer's pixels to them.
void compose(Resources& resources, const Destination& destination, const Target& target, const PixelBox& box,
             glm::ivec2 toTarget);

/// Takes premultiplied sRGB-encoded bytes to the GPU.
class ByteSender {
public:
    /// For the pixels that draw() is to send, rows from the framebuffer's lowest.
    std::uint8_t* room(glm::ivec2 size);
    void draw(Resources& resources, const Destination& destination, const PixelBox& box);
    /// Frees what it keeps on the GPU.
    void clear() { pool_.clear(); }

private:
    std::vector<std::uint8_t> pixels_;
    TargetPool pool_;
};

}  // namespace vtm::gl

/// \file
/// Draws the paper's own Vector Texture Maps (paper/model.hpp): one program that walks the recursion at every
/// pixel, for comparison with the default and for fidelity.
#pragma once

#include <memory>

#include <vtm/gl/context.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>
#include "paper/gl/surface.hpp"
#include "paper/model.hpp"

namespace vtm::paper {

/// A paper-mode asset on the GPU. Must not outlive the context.
class Texture {
public:
    /// `asset` must be valid (asset::validate). Throws GlError where it is too large for a texture.
    explicit Texture(const Asset& asset);
    ~Texture();
    Texture(Texture&&) noexcept;
    Texture& operator=(Texture&&) noexcept;

private:
    friend class Renderer;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Programs are compiled when first needed; GlError with the driver's log where one does not
/// compile. Needs a current context for its whole life, in any state, and leaves that as it was.
class Renderer {
public:
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws on transparent black and reads back. Positions are in single precision: pixels should not be
    /// smaller than 2^-20 of the picture.
    image::Raster render(const Texture& texture, const asset::View& view);
    /// The same with the picture repeated over a surface (row 12). Masks are antialiased, and their mips
    /// chosen and blended, pixel by pixel from the derivatives of (s, t). Throws std::length_error where a
    /// side of the raster is not in [1, 4096] or beyond the driver's; std::invalid_argument as
    /// UploadedSurface.
    image::Raster render(const Texture& texture, const Surface& surface, glm::ivec2 size);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::paper

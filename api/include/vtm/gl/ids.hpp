/// \file
/// Picking on the GPU: a buffer of ids, one for the region at each pixel's centre, instead of colours.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/context.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// An exact asset on the GPU with an id for each of its paints. Its objects belong to its renderer's context.
class IdTexture {
public:
    ~IdTexture();
    IdTexture(IdTexture&&) noexcept;
    IdTexture& operator=(IdTexture&&) noexcept;

private:
    friend class IdRenderer;
    struct Impl;
    explicit IdTexture(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

/// asset::paintAt on the GPU, without coverage or blending, so every result is one of the given ids. Works in
/// single precision: a pixel whose centre is nearer to a boundary than 2^-20 of the side of the leaf or view
/// may get the id of the other side. Handles contexts and state as Renderer does.
class IdRenderer {
public:
    IdRenderer();
    ~IdRenderer();
    IdRenderer(const IdRenderer&) = delete;
    IdRenderer& operator=(const IdRenderer&) = delete;

    /// `asset` must be valid (asset::validate). `idOfPaint` has an id for each paint. Throws
    /// std::invalid_argument for an asset of compat mode.
    IdTexture upload(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint);

    /// Returns the ids of the pixels, row by row; pixels outside the picture have the id of paint 0.
    std::vector<std::uint32_t> render(const IdTexture& texture, const asset::View& view);

    /// Draws the ids into the view's rectangle, from pixel (0, 0), of the caller's framebuffer, whose first
    /// draw buffer must hold unsigned integers (GL_R32UI). Empty: the framebuffer bound for drawing.
    void draw(const IdTexture& texture, const asset::View& view, std::optional<unsigned> framebuffer = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

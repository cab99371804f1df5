/// \file
/// Which region shows at each pixel's centre: a buffer of numbers instead of colours, for picking on the GPU.
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

/// An exact asset on the GPU with a number for each of its paints. Belongs to its renderer's context.
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

/// The GPU's asset::paintAt: no coverage, no blending, so a number is always one of the numbers given. In
/// single precision: pixels whose centre is nearer to a boundary than 2^-20 of the leaf's or the view's side
/// may have the number of its other side. Contexts and state as with Renderer.
class IdRenderer {
public:
    IdRenderer();
    ~IdRenderer();
    IdRenderer(const IdRenderer&) = delete;
    IdRenderer& operator=(const IdRenderer&) = delete;

    /// `asset` must be valid (asset::validate) and exact, std::invalid_argument otherwise; `idOfPaint` has a
    /// number for each paint.
    IdTexture upload(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint);

    /// By pixel, row by row; where nothing is, paint 0's.
    std::vector<std::uint32_t> render(const IdTexture& texture, const asset::View& view);

    /// Into the view's rectangle, from pixel (0, 0), of a framebuffer of the user's whose first draw buffer
    /// holds unsigned integers (GL_R32UI); nothing: the one bound for drawing.
    void draw(const IdTexture& texture, const asset::View& view, std::optional<unsigned> framebuffer = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

/// \file
/// Draws assets with OpenGL ES 3.0: upload once, draw under any affine view.
#pragma once

#include <memory>

#include "asset/asset.hpp"
#include "asset/view.hpp"
#include "backend_gl/context.hpp"
#include "image/bitmap.hpp"

namespace vtm::gl {

/// An asset on the GPU. Belongs to the renderer that uploaded it and must not outlive it.
class Texture {
public:
    ~Texture();
    Texture(Texture&&) noexcept;
    Texture& operator=(Texture&&) noexcept;

private:
    friend class Renderer;
    struct Impl;
    explicit Texture(std::unique_ptr<Impl>);
    std::unique_ptr<Impl> impl_;
};

/// The programs, each compiled once, when first needed; GlError with the driver's log where one does
/// not compile. Needs a current context for its whole life.
class Renderer {
public:
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// `asset` must be valid (asset::validate). Compiles its materials, each list of them once; what is wrong
    /// in one is a GlError that begins "material 'NAME', line L: ", or with all names where the driver's log
    /// does not say which.
    Texture upload(const asset::AssetView& asset);

    /// Draws on transparent black into a texture of the renderer's own and reads it back.
    image::Raster render(const Texture& texture, const asset::View& view);

    /// Draws and waits for the GPU without reading back (for measuring).
    void draw(const Texture& texture, const asset::View& view);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

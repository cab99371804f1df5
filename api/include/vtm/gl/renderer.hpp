/// \file
/// Draws assets with OpenGL ES 3.0: upload once, draw under any affine view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/context.hpp>
#include <vtm/gl/output.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// Who makes the pixels of exact pictures that are drawn into 8-bit framebuffers without conversions.
enum class Pixels {
    Automatic,  ///< Scanned where the driver runs shaders on the CPU (llvmpipe and the like), else Shaders
    Shaders,
    Scanned  ///< vtm/raster/scan.hpp, on the CPU, several times faster there; pictures with materials take
             ///< Shaders
};

/// Premultiplied sRGB-encoded bytes red, green, blue, alpha; rows from the top.
struct BytePixels {
    const std::uint8_t* pixels = nullptr;
    int width = 0, height = 0;
    std::size_t rowBytes = 0;  ///< from one row to the next, at least 4 · width
};

struct RendererOptions {
    /// Of draw(). render() and renderBitmap() show what the shaders make.
    Pixels pixels = Pixels::Automatic;

    /// Whether every call leaves GL's state as it found it (docs/backend.md). Without, what a call may touch
    /// is anything afterwards.
    bool restoreState = true;
    /// Keeps the driver's binaries of programs in this directory, if it has formats for them, and loads them
    /// from there; made if missing. Empty: no files. Only the user may be able to write there.
    std::string programCache;
    /// Paints pixels magenta whose shader was stopped by the driver before its end, which is a fault of ours;
    /// else they are opaque, in about the colour of the place (docs/backend.md).
    bool markOverruns = false;
    /// Turns of loops that a pixel may take before the CPU makes it; 0: what every driver allows. Others are
    /// for tests.
    unsigned maxTurns = 0;

    /// Returns GL's graphics reset status, 0 for none; empty: the driver's own, where it has one.
    std::function<unsigned()> resetStatus;
};

class Renderer;

/// An asset on the GPU. It must not outlive the renderer that uploaded it, unless it has one of its own.
class Texture {
public:
    /// With a renderer of its own, in the context that is current. Several pictures are better uploaded by
    /// one renderer, which compiles its programs once. Throws as Renderer and Renderer::upload do.
    explicit Texture(const asset::AssetView& asset, const RendererOptions& options = {});
    ~Texture();
    Texture(Texture&&) noexcept;
    Texture& operator=(Texture&&) noexcept;

    /// Renderer::draw, by the renderer that uploaded it.
    void draw(const asset::View& view, const Output& output = {}) const;

    /// How far the picture may be magnified: asset::Asset::finestPixel.
    std::optional<double> finestPixel() const;

private:
    friend class Renderer;
    struct Impl;
    Texture(std::unique_ptr<Impl> impl, Renderer& renderer);
    std::unique_ptr<Renderer> own_;  ///< outlives impl_
    Renderer* renderer_;
    std::unique_ptr<Impl> impl_;
};

/// Programs so far.
struct ProgramFigures {
    unsigned made = 0;
    unsigned compiled = 0;  ///< of these; the others came from the cache
};

/// The programs, each compiled once, when first needed; GlError with the driver's log where one does
/// not compile.
///
/// Works in the context that is current when it is made, ours or the user's, which must be current in every
/// call: GlError otherwise. GL's state may be anything. Destroyed with its context current it frees its
/// objects; without, they are left to the context's end. Destroy renderers of a context that is gone before
/// making the next: EGL may use its name again.
///
/// Every call may throw OutOfMemory, after which the renderer goes on working, and ContextLost, after which
/// every other does, too.
class Renderer {
public:
    /// Throws GlError if no context is current or what it can do is not enough.
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// `asset` must be valid (asset::validate). Compiles its materials, each list of them once; what is wrong
    /// in one is a GlError that begins "material 'NAME', line L: ", or with all names where the driver's log
    /// does not say which.
    Texture upload(const asset::AssetView& asset);

    /// Draws on transparent black into a texture of the renderer's own and reads it back.
    image::Raster render(const Texture& texture, const asset::View& view);

    /// The same in 8 bits, which is faster: within 1/255 of image::toBitmap(render()) where alpha is not 0.
    image::Bitmap renderBitmap(const Texture& texture, const asset::View& view);

    /// Draws into a framebuffer of the user's. Does not wait for the GPU. Throws std::invalid_argument for an
    /// Output that contradicts itself.
    void draw(const Texture& texture, const asset::View& view, const Output& output);

    /// Pixels that others made, as a view of their size. Of `output.damage` only these pixels are read.
    /// Throws std::invalid_argument for an Output that contradicts itself or wants linear light: they are
    /// mixed already.
    void draw(const BytePixels& pixels, const Output& output);

    /// Draws into 8 bits of the renderer's own and waits for the GPU, without reading back (for measuring).
    void draw(const Texture& texture, const asset::View& view);

    /// Whether the context was reset, as far as the driver tells.
    bool lost() const;

    ProgramFigures programs() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

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
#include <vtm/asset/difference.hpp>
#include <vtm/gl/context.hpp>
#include <vtm/gl/output.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// Selects what computes the pixels of exact pictures drawn into 8-bit framebuffers without conversion.
enum class Pixels {
    Automatic,  ///< Scanned where the driver runs shaders on the CPU (llvmpipe and the like), else Shaders.
                ///< Drivers that GL_RENDERER does not tell are timed once in a process, for some milliseconds
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
    /// Applies to draw(); render() and renderBitmap() always use the shaders.
    Pixels pixels = Pixels::Automatic;

    /// Whether every call restores GL's state (docs/backend.md). If false, the state that a call may touch is
    /// undefined afterwards.
    bool restoreState = true;
    /// Keeps the driver's binaries of programs in this directory, if it has formats for them, and loads them
    /// from there; made if missing. Empty: no files. Only the user may be able to write there.
    std::string programCache;
    /// Paints a pixel magenta if the driver stopped its shader early, which is a bug in this library.
    /// Otherwise such a pixel is opaque with approximately the right colour (docs/backend.md).
    bool markOverruns = false;
    /// Max loop iterations for a pixel in a shader before the CPU computes it; 0: a number that every driver
    /// allows. Other values are for tests.
    unsigned maxTurns = 0;

    /// Returns GL's graphics reset status, 0 for none; empty: the driver's own, where it has one.
    std::function<unsigned()> resetStatus;
};

class Renderer;

/// An asset on the GPU. It must not outlive the renderer that uploaded it, unless it owns its renderer.
class Texture {
public:
    /// Makes a renderer of its own in the current context. To draw several pictures, upload them with one
    /// Renderer, which compiles its programs once. Throws as Renderer and Renderer::upload do.
    explicit Texture(const asset::AssetView& asset, const RendererOptions& options = {});
    ~Texture();
    Texture(Texture&&) noexcept;
    Texture& operator=(Texture&&) noexcept;

    /// Renderer::draw, by the renderer that uploaded it.
    void draw(const asset::View& view, const Output& output = {}) const;

    /// Renderer::update, by the renderer that uploaded it.
    std::size_t update(const asset::AssetView& asset, const asset::Difference& difference);

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

/// Number of GL programs made so far.
struct ProgramFigures {
    unsigned made = 0;
    unsigned compiled = 0;  ///< of these; the others came from the cache
};

/// Draws assets with programs that are compiled once, when first needed. Throws GlError with the driver's log
/// if one does not compile.
///
/// A renderer belongs to the context that is current when it is made, a vtm::gl::Context or the caller's own.
/// That context must be current in every call; otherwise the call throws GlError. GL's state may be
/// arbitrary. The destructor frees GL objects if the context is current; otherwise they live until the
/// context ends. Destroy the renderers of a lost context before you make another context: EGL may reuse its
/// handle.
///
/// Every call may throw OutOfMemory, after which the renderer remains usable, and ContextLost, after which
/// every later call throws it too.
class Renderer {
public:
    /// Throws GlError if no context is current or the context lacks a required feature.
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// `asset` must be valid (asset::validate). Compiles its materials, each distinct list once. An error in
    /// a material throws GlError with a message that begins "material 'NAME', line L: ", or with all names if
    /// the driver's log does not say which.
    Texture upload(const asset::AssetView& asset);

    /// Shows the next asset instead of the one that the texture shows: compiler::Session's result and
    /// difference(). Colours of paints are sent where they changed, and squares of the map that changed are
    /// made anew when they are drawn. Returns the bytes sent. Where more changed (compat mode, filters,
    /// images, materials, instances, Difference::everything) the asset is uploaded as a whole. Throws as
    /// upload() does; the texture then shows either asset.
    std::size_t update(Texture& texture, const asset::AssetView& asset, const asset::Difference& difference);

    /// Compiles in advance what drawing `texture` into such an output needs, so that the first picture does
    /// not wait for it: the programs of a picture, or of layers; those of filters, and of cells that the CPU
    /// computes (docs/backend.md), are compiled when they are first needed. Where the driver compiles on
    /// threads of its own (GL_KHR_parallel_shader_compile) it returns false until they are done: call it
    /// again, once a frame. Elsewhere it returns true when they are compiled. draw() may come at any time and
    /// waits for what it needs. Throws as draw() does.
    bool warmUp(const Texture& texture, const Output& output = {});

    /// Draws on transparent black into a texture of the renderer's own and reads it back.
    image::Raster render(const Texture& texture, const asset::View& view);

    /// The same in 8 bits, which is faster. Differs from image::toBitmap(render()) by at most 1/255 where
    /// alpha is not 0.
    image::Bitmap renderBitmap(const Texture& texture, const asset::View& view);

    /// Draws into the caller's framebuffer and does not wait for the GPU. Throws std::invalid_argument if
    /// members of `output` contradict each other.
    void draw(const Texture& texture, const asset::View& view, const Output& output);

    /// Draws given pixels as a view of their size. If `output.damage` is set, reads only those pixels. Throws
    /// std::invalid_argument if members of `output` contradict each other or ask for linear light, since the
    /// pixels are already composited.
    void draw(const BytePixels& pixels, const Output& output);

    /// Draws into an internal 8-bit target and waits for the GPU, without reading back; for measuring.
    void draw(const Texture& texture, const asset::View& view);

    /// Returns whether the context was reset, as far as the driver reports it.
    bool lost() const;

    ProgramFigures programs() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

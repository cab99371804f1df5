/// \file
/// Draws the paper's own Vector Texture Maps (asset/paper.hpp): one program that walks the recursion at every
/// pixel, for comparison with the default and for fidelity.
#pragma once

#include <memory>

#include <vtm/gl/context.hpp>
#include "asset/paper.hpp"

namespace vtm::gl {

/// A paper-mode asset on the GPU. Must not outlive the context.
class PaperTexture {
public:
    /// `asset` must be valid (asset::validate). Throws GlError where it is too large for a texture.
    explicit PaperTexture(const asset::PaperAsset& asset);
    ~PaperTexture();
    PaperTexture(PaperTexture&&) noexcept;
    PaperTexture& operator=(PaperTexture&&) noexcept;

private:
    friend class PaperRenderer;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Programs are compiled when first needed; GlError with the driver's log where one does not
/// compile. Needs a current context for its whole life, in any state, and leaves that as it was.
class PaperRenderer {
public:
    PaperRenderer();
    ~PaperRenderer();
    PaperRenderer(const PaperRenderer&) = delete;
    PaperRenderer& operator=(const PaperRenderer&) = delete;

    /// Draws on transparent black and reads back. Positions are in single precision: pixels should not be
    /// smaller than 2^-20 of the picture.
    image::Raster render(const PaperTexture& texture, const asset::View& view);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

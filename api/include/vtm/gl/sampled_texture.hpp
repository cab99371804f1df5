/// \file
/// Assets as textures in the caller's own programs and context: GLSL to include in a shader, and the textures
/// to bind to its uniforms. docs/texture.md explains their use and cost.
///
///     uniform Vtm sign;
///     vec4 c = vtm_sample(sign, st);   // premultiplied; (0, 0) is the picture's upper left corner, t runs
///     down
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/context.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/raster/prefilter.hpp>

#pragma GCC visibility push(default)

namespace vtm::gl {

/// Returns GLSL ES 3.00 to insert in a fragment shader after `#version 300 es` and before its own text. It
/// defines the type Vtm and the functions vtm_sample and vtm_sample_grad for these assets (and any with the
/// same kinds of paints and the same materials). Every other name begins with `vtm_` or `VTM_`, but for those
/// in the assets' materials. Sets the default precision of everything to highp. Lines are counted from 1
/// again behind it; material i is source string 30000 + i in a driver's log. Throws GlError if two different
/// materials have one name.
std::string sampleInclude(std::span<const asset::AssetView> assets);
std::string sampleInclude(std::initializer_list<asset::AssetView> assets);

/// How coordinates beyond [0, 1] are treated along each axis.
struct Wrapping {
    asset::Wrap s = asset::Wrap::Border, t = asset::Wrap::Border;
};

/// An asset of exact mode on the GPU, for any number of programs. Needs the context that was current when it
/// was made, or one that shares textures and samplers with it, for its whole life.
class SampledTexture {
public:
    /// `asset` must be valid (asset::validate) and is not needed afterwards; without a prefilter, one is
    /// built. Leaves GL's state as it was. Throws GlError if no context is current, the asset is in compat
    /// mode, a texture would be larger than the driver allows, or GL reports an error (which may be an
    /// earlier, unqueried one).
    explicit SampledTexture(const asset::AssetView& asset, const asset::PrefilterOptions& options = {});
    ~SampledTexture();
    SampledTexture(SampledTexture&&) noexcept;
    SampledTexture& operator=(SampledTexture&&) noexcept;

    /// Shows another asset instead, as one whose placements changed (vtm/asset/placements.hpp). Sends only
    /// the records that differ from those of the update before, as long as they fit in the texture;
    /// everything the first time. Returns the bytes sent. With `means`, the pyramid of means is made anew,
    /// which costs more than all the rest; without, views from far away show the picture as it was. `pixels`
    /// selects who makes it: shaders draw it where the driver does not run them on the CPU, by programs that
    /// the first such update compiles (docs/prefilter.md). Throws as the constructor does, and
    /// std::invalid_argument if the asset needs another include (sampleInclude) or has images. Programs show
    /// the new picture after the next bind().
    std::size_t update(const asset::AssetView& asset, bool means = true, Pixels pixels = Pixels::Automatic);

    /// How far the picture may be magnified: asset::Asset::finestPixel, in user units. A fragment whose
    /// footprint is narrower (the derivatives of st times the picture's width and height) sees boundaries
    /// that may be off by more than a sixteenth of it.
    std::optional<double> finestPixel() const;

    /// What it takes on the GPU: records, pyramid of means and images.
    std::size_t bytes() const;

    /// Number of texture units that bind() uses: two, or three for an asset with images.
    unsigned units() const;

    /// Sets `uniform Vtm NAME` of a linked program and binds textures and sampler objects to the units from
    /// firstUnit on; the rest of GL's state (current program, active unit) stays as it was. Each Vtm of a
    /// program must be bound, to units of its own. `name` may be an element of an array: "signs[1]". Throws
    /// GlError if the program has no such uniform or the driver no such unit.
    void bind(unsigned program, const std::string& name, unsigned firstUnit, Wrapping wrapping = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::gl

#pragma GCC visibility pop

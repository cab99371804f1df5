/// \file
/// Pyramids of means as textures: made by the CPU and uploaded, or drawn by the functions of vtm_sample.
#pragma once

#include <optional>
#include <string>

#include <vtm/gl/renderer.hpp>
#include <vtm/raster/prefilter.hpp>
#include "backend_gl/core/program.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/texture/vtm_uniform.hpp"

namespace vtm::gl {

struct PrefilterTexture {
    asset::PyramidSize size;
    TextureHandle texture;
};

PrefilterTexture uploadPrefilter(const asset::PrefilterView& prefilter);

/// The programs that draw pyramids: of pictures that one include serves, without images or materials.
struct PrefilterPrograms {
    PrefilterPrograms(Features features, SampledKinds kinds);

    Program mean, coarser;
};
/// What they are compiled from.
ProgramSource meanSource(Features features, SampledKinds kinds);
ProgramSource coarserSource();

/// Makes the pyramids of one texture anew whenever its picture changes.
class PrefilterMaker {
public:
    PrefilterMaker(Features features, SampledKinds kinds) : features_(features), kinds_(kinds) {}

    /// Of an asset that draws one map. `uniform` and `records`: the same picture, as vtm_sample knows it.
    /// Draws where the CPU would take longer, as far as `pixels` leaves the choice and the driver can draw
    /// into float textures. The CPU makes those of images, whose texture is not asked for, and of materials,
    /// which it shows as its renderers do; very large ones; and those where a texel takes more turns than a
    /// fragment may. GL is in the state of StateGuard. Throws GlError.
    PrefilterTexture make(const asset::AssetView& asset, const asset::PrefilterOptions& options,
                          Pixels pixels, const VtmUniform& uniform, GLuint records);
    /// Whether any was drawn.
    bool hasDrawn() const { return programs_.has_value(); }

private:
    Features features_;
    SampledKinds kinds_;
    std::optional<PrefilterPrograms> programs_;  ///< compiled when they are first needed
};

}  // namespace vtm::gl

#include <vtm/gl/sampled_texture.hpp>

#include "backend_gl/core/features.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/texture/vtm_uniform.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;

const asset::Map& onlyMap(const AssetView& asset) {
    if (asset.mode != asset::Mode::Exact)
        throw GlError("an asset of compat mode cannot be sampled: it has layers, not regions");
    if (asset.commands.size() != 1 || asset.commands[0].kind != asset::Command::Kind::DrawMap)
        throw GlError("only an asset that draws one map can be sampled");
    return asset.maps[asset.commands[0].map];
}

}  // namespace

struct SampledTexture::Impl {
    Impl(const AssetView& asset, const asset::PrefilterView& pyramid)
        : Impl(asset, pyramid, imageTexels(asset)) {}
    Impl(const AssetView& asset, const asset::PrefilterView& pyramid, ImageTexels pictures)
        : finestPixel(asset.finestPixel), prefilter(uploadPrefilter(pyramid)) {
        const Features features = featuresOf(asset);
        uniform.width = asset.width;
        uniform.height = asset.height;
        uniform.map = onlyMap(asset);
        uniform.flags = samplingFlags(features, {innerMapsOf(asset), false});
        uniform.prefilterSize = pyramid.size;
        texels = texelTexture(recordTexels(asset, pictures.list, uniform.parts));
        if (features.has(Features::Image))
            images = imageTexture(std::move(pictures.rgba));
    }

    std::optional<double> finestPixel;
    VtmUniform uniform;
    TextureHandle texels, prefilter, images;
    Samplers samplers;
};

SampledTexture::SampledTexture(const AssetView& asset, const asset::PrefilterOptions& options) {
    onlyMap(asset);
    requireCurrentContext();
    asset::Prefilter made;
    asset::PrefilterView pyramid = asset.prefilter;
    if (pyramid.size.empty()) {
        made = asset::buildPrefilter(asset, options);
        pyramid = {made.size, made.texels};
    }
    checkErrors("something before this texture was made");
    const StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(asset, pyramid);
}
SampledTexture::~SampledTexture() = default;
SampledTexture::SampledTexture(SampledTexture&&) noexcept = default;
SampledTexture& SampledTexture::operator=(SampledTexture&&) noexcept = default;

std::optional<double> SampledTexture::finestPixel() const { return impl_->finestPixel; }

unsigned SampledTexture::units() const { return impl_->images.get() != 0 ? 3 : 2; }

void SampledTexture::bind(unsigned program, const std::string& name, unsigned firstUnit, Wrapping wrapping) {
    const Binding binding(program, name, firstUnit, units());
    impl_->uniform.set(program, name, wrapping);
    binding.texture("texels", 0, impl_->texels.get(), 0);
    binding.texture("prefilter", 1, impl_->prefilter.get(), impl_->samplers.of(wrapping));
    if (impl_->images.get() != 0)
        binding.texture("images", 2, impl_->images.get(), 0);
    else
        binding.unused("images", 1);
    checkErrors("binding a texture");
}

}  // namespace vtm::gl

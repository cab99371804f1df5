#include <vtm/gl/sampled_texture.hpp>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/features.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/texture/vtm_uniform.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;

const asset::Map& onlyMap(const AssetView& asset) {
    if (asset.mode != asset::Mode::Exact)
        throw GlError("an asset of compat mode cannot be sampled: it has layers, not regions");
    if (asset.commands.size() != 1 || asset.commands[0].kind != asset::Command::Kind::DrawMap)
        throw GlError(asset.filters.empty()
                          ? "only an asset that draws one map can be sampled"
                          : "an asset with filters cannot be sampled: compile it with Options::filterPixels");
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
        records = RecordTexture(recordTexels(asset, pictures.list, uniform.parts));
        if (features.has(Features::Image)) {
            imageBytes = pictures.rgba.size();
            images = imageTexture(std::move(pictures.rgba));
        }
    }

    std::size_t update(const AssetView& asset) {
        const std::uint32_t flags = samplingFlags(featuresOf(asset), {innerMapsOf(asset), false});
        if (flags != uniform.flags || !asset.images.empty())
            throw std::invalid_argument(
                "update of a texture: the asset has other kinds of paints, or maps nested more or less deep");
        std::vector<Texel> next = recordTexels(asset, {}, uniform.parts);
        uniform.width = asset.width;
        uniform.height = asset.height;
        uniform.map = onlyMap(asset);
        finestPixel = asset.finestPixel;
        return records.update(std::move(next));
    }

    std::optional<double> finestPixel;
    VtmUniform uniform;
    RecordTexture records;
    TextureHandle prefilter, images;
    std::size_t imageBytes = 0;
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

std::size_t SampledTexture::update(const AssetView& asset, bool means) {
    onlyMap(asset);
    requireCurrentContext();
    checkErrors("something before this texture was updated");
    asset::Prefilter made;
    asset::PrefilterView pyramid = asset.prefilter;
    if (means && pyramid.size.empty()) {
        made = asset::buildPrefilter(asset);
        pyramid = {made.size, made.texels};
    }
    const StateContract contract;
    const StateGuard guard(contract, true);
    const std::size_t sent = impl_->update(asset);
    if (means) {
        impl_->prefilter = uploadPrefilter(pyramid);
        impl_->uniform.prefilterSize = pyramid.size;
    }
    return sent;
}

std::optional<double> SampledTexture::finestPixel() const { return impl_->finestPixel; }

std::size_t SampledTexture::bytes() const {
    constexpr std::size_t texelBytes = 4;
    const asset::PyramidSize& means = impl_->uniform.prefilterSize;
    return impl_->records.bytes() + means.texelsBefore(means.levels()) * texelBytes + impl_->imageBytes;
}

unsigned SampledTexture::units() const { return impl_->images.get() != 0 ? 3 : 2; }

void SampledTexture::bind(unsigned program, const std::string& name, unsigned firstUnit, Wrapping wrapping) {
    const Binding binding(program, name, firstUnit, units());
    impl_->uniform.set(program, name, wrapping);
    binding.texture("texels", 0, impl_->records.texture().get(), 0);
    binding.texture("prefilter", 1, impl_->prefilter.get(), impl_->samplers.of(wrapping));
    if (impl_->images.get() != 0)
        binding.texture("images", 2, impl_->images.get(), 0);
    else
        binding.unused("images", 1);
    checkErrors("binding a texture");
}

}  // namespace vtm::gl

#include <vtm/gl/sampled_texture.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "asset/walk.hpp"
#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/features.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/sampled_data.hpp"
#include "backend_gl/texture/prefilter_texture.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/texture/vtm_uniform.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;
using glm::dvec2;

const asset::Map& onlyMap(const AssetView& asset) {
    if (asset.mode != asset::Mode::Exact)
        throw GlError("an asset of compat mode cannot be sampled: it has layers, not regions");
    if (asset.commands.size() != 1 || asset.commands[0].kind != asset::Command::Kind::DrawMap)
        throw GlError(asset.filters.empty()
                          ? "only an asset that draws one map can be sampled"
                          : "an asset with filters cannot be sampled: compile it with Options::filterPixels");
    return asset.maps[asset.commands[0].map];
}

/// The paint that has most of the area of the picture's solid squares, programs left out; 0, which is
/// transparent, if there are none.
std::uint32_t groundOf(const AssetView& asset, const asset::Map& map) {
    std::vector<double> areas(asset.paints.size());
    asset::walk(asset, map.root, [&](asset::Cell cell, asset::Entry entry) {
        if (entry.kind() != asset::Entry::Kind::Solid || asset::isProgram(asset.paints[entry.payload()]))
            return;
        const double side = std::ldexp(map.side, -2 * int(cell.level));
        const dvec2 corner = dvec2(map.x, map.y) + dvec2(cell.x, cell.y) * side;
        const dvec2 inside =
            glm::min(corner + side, dvec2(asset.width, asset.height)) - glm::max(corner, dvec2(0));
        areas[entry.payload()] += std::max(inside.x, 0.0) * std::max(inside.y, 0.0);
    });
    return std::uint32_t(std::ranges::max_element(areas) - areas.begin());
}

/// An asset as a `uniform Vtm`, before it is uploaded.
struct Sampled {
    explicit Sampled(const AssetView& asset) : images(imageTexels(asset)) {
        const Features features = featuresOf(asset);
        uniform.width = asset.width;
        uniform.height = asset.height;
        uniform.map = onlyMap(asset);
        uniform.ground = groundOf(asset, uniform.map);
        uniform.flags = samplingFlags(features, {innerMapsOf(asset), false});
        records = recordTexels(asset, images.list, uniform.parts);
        hasImages = features.has(Features::Image);
    }

    VtmUniform uniform;
    ImageTexels images;
    std::vector<Texel> records;
    bool hasImages;
};

}  // namespace

struct SampledTexture::Impl {
    Impl(const AssetView& asset, const asset::PrefilterOptions& o) : Impl(asset, o, Sampled(asset)) {
        makePrefilter(asset, Pixels::Scanned);  // programs would take longer to compile
    }
    Impl(const AssetView& asset, const asset::PrefilterOptions& o, Sampled sampled)
        : options(o),
          finestPixel(asset.finestPixel),
          uniform(sampled.uniform),
          records(std::move(sampled.records)),
          maker(featuresOf(asset), {innerMapsOf(asset), false}) {
        if (sampled.hasImages) {
            imageBytes = sampled.images.rgba.size();
            images = imageTexture(std::move(sampled.images.rgba));
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
        uniform.ground = groundOf(asset, uniform.map);
        finestPixel = asset.finestPixel;
        return records.update(std::move(next));
    }

    void makePrefilter(const AssetView& asset, Pixels pixels) {
        PrefilterTexture made = maker.make(asset, options, pixels, uniform, records.texture().get());
        uniform.prefilterSize = made.size;
        prefilter = std::move(made.texture);
    }

    asset::PrefilterOptions options;
    std::optional<double> finestPixel;
    VtmUniform uniform;
    RecordTexture records;
    TextureHandle prefilter, images;
    PrefilterMaker maker;
    std::size_t imageBytes = 0;
    Samplers samplers;
};

SampledTexture::SampledTexture(const AssetView& asset, const asset::PrefilterOptions& options) {
    onlyMap(asset);
    requireCurrentContext();
    checkErrors("something before this texture was made");
    const StateContract contract;
    const StateGuard guard(contract, true, Touched::uploads());
    impl_ = std::make_unique<Impl>(asset, options);
}
SampledTexture::~SampledTexture() = default;
SampledTexture::SampledTexture(SampledTexture&&) noexcept = default;
SampledTexture& SampledTexture::operator=(SampledTexture&&) noexcept = default;

std::size_t SampledTexture::update(const AssetView& asset, bool means, Pixels pixels) {
    onlyMap(asset);
    requireCurrentContext();
    checkErrors("something before this texture was updated");
    const StateContract contract;
    const StateGuard guard(contract, true, means ? Touched::picture(false) : Touched::uploads());
    const std::size_t sent = impl_->update(asset);
    if (means)
        impl_->makePrefilter(asset, pixels);
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

namespace {

/// The asset's own, or one that is built.
struct Pyramid {
    Pyramid(const AssetView& asset, const asset::PrefilterOptions& options) : view(asset.prefilter) {
        if (view.size.empty()) {
            made = asset::buildPrefilter(asset, options);
            view = {made.size, made.texels};
        }
    }
    Pyramid(const Pyramid&) = delete;  // the view is of what was made
    Pyramid& operator=(const Pyramid&) = delete;

    asset::Prefilter made;
    asset::PrefilterView view;
};

TextureData prefilterData(const asset::PrefilterView& pyramid) {
    TextureData data{"prefilter",
                     TextureData::Format::Rgba8,
                     pyramid.size.width,
                     pyramid.size.height,
                     pyramid.size.levels(),
                     true,
                     {}};
    const auto bytes = std::as_bytes(std::span(pyramid.texels));
    data.bytes.resize(bytes.size());
    std::memcpy(data.bytes.data(), bytes.data(), bytes.size());
    return data;
}

}  // namespace

ShaderData sampledData(const AssetView& asset, const asset::PrefilterOptions& options) {
    onlyMap(asset);
    const Pyramid pyramid(asset, options);
    Sampled sampled(asset);
    sampled.uniform.prefilterSize = pyramid.view.size;
    ShaderData data;
    data.textures.push_back(texelData("texels", sampled.records));
    data.textures.push_back(prefilterData(pyramid.view));
    if (sampled.hasImages)
        data.textures.push_back(imageData("images", sampled.images.rgba));
    data.uniforms = sampled.uniform.values({});
    return data;
}

}  // namespace vtm::gl

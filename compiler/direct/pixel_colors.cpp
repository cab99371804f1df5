#include "compiler/direct/pixel_colors.hpp"

#include <algorithm>
#include <bit>

#include <glm/common.hpp>

#include "compiler/paint/region_paints.hpp"
#include "raster/blend.hpp"

namespace vtm::compiler {
namespace {

constexpr std::size_t mostKnown = 1u << 14;

using Float4 = float __attribute__((vector_size(16)));

Float4 over(Float4 source, Float4 backdrop) { return source + (1 - source[3]) * backdrop; }

/// A group, or a mask.
Float4 laidOver(const asset::Instruction& in, Float4 source, Float4 below) {
    const auto group = std::bit_cast<glm::vec4>(source);
    if (in.op != asset::Op::Pop)
        return asset::maskFactor(in.op, group) * below;
    if (in.blend == asset::Blend::Normal)
        return over(in.opacity * source, below);
    return std::bit_cast<Float4>(asset::blend(in.blend, in.opacity * group, std::bit_cast<glm::vec4>(below)));
}

}  // namespace

template <class Make>
const PixelColors::Known& PixelColors::remembered(std::vector<Known>& known, std::uint64_t key, int x,
                                                  int row, const Make& make) {
    const std::uint64_t place = std::uint64_t(row) << 16 | std::uint64_t(x);
    Known& one = known[hashValue(key ^ hashValue(place)) % mostKnown];
    if (one.key != key || one.x != x || one.row != row) {
        one = {key, x, row, false, {}};
        make(one);
    }
    return one;
}

glm::vec4 PixelColors::color(std::uint64_t key, std::span<const PaintStep> program, const PixelPlace& place) {
    if (!sources_)
        make();
    const Known& known = remembered(programs_, key, place.x, place.row, [&](Known& one) {
        one.isSteep = isSteep(program);
        one.quarters =
            one.isSteep ? composite<4>(program, one.x, one.row) : composite<1>(program, one.x, one.row);
    });
    const Quarters& quarters = known.quarters;
    if (!known.isSteep)
        return std::bit_cast<glm::vec4>(quarters[0]);
    const glm::vec2 at = glm::clamp(2.0f * place.middle - 0.5f, 0.0f, 1.0f);
    const Float4 upper = quarters[0] + at.x * (quarters[1] - quarters[0]),
                 lower = quarters[2] + at.x * (quarters[3] - quarters[2]);
    return std::bit_cast<glm::vec4>(upper + at.y * (lower - upper));
}

bool PixelColors::isSteep(std::span<const PaintStep> program) const {
    return std::ranges::any_of(program, [&](const PaintStep& step) {
        return step.instruction.op > asset::Op::Solid && sources_->isSteep[step.instruction.argument] != 0;
    });
}

template <std::size_t parts>
PixelColors::Quarters PixelColors::composite(std::span<const PaintStep> program, int x, int row) {
    groups_.assign(1, {});
    const auto layOver = [&](float opacity, const auto& sourceOf) {
        Quarters& below = groups_.back();
        for (std::size_t i = 0; i < parts; ++i)
            below[i] = over(opacity * sourceOf(i), below[i]);
    };
    for (const PaintStep& step : program) {
        const asset::Instruction& in = step.instruction;
        switch (in.op) {
            case asset::Op::Push:
                groups_.emplace_back();
                break;
            case asset::Op::Pop:
            case asset::Op::PopMaskLuminance:
            case asset::Op::PopMaskLinear:
            case asset::Op::PopMaskAlpha: {
                const Quarters source = groups_.back();
                groups_.pop_back();
                for (std::size_t i = 0; i < parts; ++i)
                    groups_.back()[i] = laidOver(in, source[i], groups_.back()[i]);
                break;
            }
            case asset::Op::Solid:
                layOver(in.opacity, [&](std::size_t) { return std::bit_cast<Float4>(step.color); });
                break;
            default: {
                const Known& layer = ofLayer(in.argument, x, row);
                layOver(in.opacity, [&](std::size_t i) { return layer.quarters[layer.isSteep ? i : 0]; });
            }
        }
    }
    return groups_.back();
}

const PixelColors::Known& PixelColors::ofLayer(std::uint32_t data, int x, int row) {
    return remembered(layers_, data, x, row, [&](Known& one) {
        const asset::PixelPaints& pixels = *sources_->pixels;
        const std::uint32_t paint = sources_->paints[data];
        one.isSteep = sources_->isSteep[data] != 0;
        if (one.isSteep)
            one.quarters = std::bit_cast<Quarters>(pixels.quarters(paint, x, row));
        else
            one.quarters[0] = std::bit_cast<Float4>(pixels.color(paint, x, row));
    });
}

void PixelColors::make() {
    sources_ = std::make_unique<Sources>();
    asset::Asset& asset = sources_->asset;
    asset.data = picture_.data;
    sources_->paints.resize(picture_.data.size(), noIndex);
    for (const Source& source : picture_.sources)
        if (source.op != asset::Op::Solid && sources_->paints[source.data] == noIndex) {
            sources_->paints[source.data] = std::uint32_t(asset.paints.size());
            asset.paints.push_back(
                encodePaint({{{source.op, asset::Blend::Normal, 1, source.data}, {}}}, asset.data));
        }
    asset::AssetView view(asset);
    view.images = bitmaps_;
    sources_->pixels.emplace(view, images_, view_);
    sources_->isSteep.resize(picture_.data.size());
    for (const Source& source : picture_.sources)
        if (source.op != asset::Op::Solid)
            sources_->isSteep[source.data] = sources_->pixels->isSteep(sources_->paints[source.data]);
    programs_.resize(mostKnown);
    layers_.resize(mostKnown);
}

}  // namespace vtm::compiler

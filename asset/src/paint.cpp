#include "asset/src/paint.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include <glm/common.hpp>

#include "asset/src/blend.hpp"
#include "asset/src/gradient.hpp"

namespace vtm::asset {

namespace {

using glm::vec2;
using glm::vec4;

vec4 floats(const Texel& t) {
    return {std::bit_cast<float>(t[0]), std::bit_cast<float>(t[1]), std::bit_cast<float>(t[2]),
            std::bit_cast<float>(t[3])};
}

// ---- Materials ------------------------------------------------------------------------------------

vec4 materialColor(const MaterialFill& fill, vec2 point, const MaterialFunction& materials) {
    if (!materials)
        return {fill.fallback[0], fill.fallback[1], fill.fallback[2], fill.fallback[3]};
    return glm::clamp(materials(fill.material, applyMatrix(fill.matrix, point)), 0.0f, 1.0f);
}

// ---- Programs -------------------------------------------------------------------------------------

/// Places along a row.
struct Row {
    PaintPlace first;
    vec2 step;

    vec2 point(std::size_t i) const { return first.point + float(i) * step; }
};

void layerColors(const Paints& paints, const Instruction& in, const Row& row,
                 const MaterialFunction& materials, std::span<vec4> colors) {
    const std::span<const Texel> data = paints.asset().data;
    const auto each = [&](auto&& color) {
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = color(row.point(i));
    };
    switch (in.op) {
        case Op::Solid:
            std::ranges::fill(colors, floats(data[in.argument]));
            return;
        case Op::Image: {
            const auto fill = recordAt<ImageFill>(data, in.argument);
            return each([&](vec2 p) { return paints.images().color(fill, p, row.first.pixel); });
        }
        case Op::Material: {
            const auto fill = recordAt<MaterialFill>(data, in.argument);
            return each([&](vec2 p) { return materialColor(fill, p, materials); });
        }
        case Op::Linear:
            return linearColors({data, paints.stopColors(), in.argument}, row.first.point, row.step,
                                row.first.pixel, colors);
        default:
            return radialColors({data, paints.stopColors(), in.argument}, row.first.point, row.step,
                                row.first.pixel, colors);
    }
}

/// Colours of so many places are made together.
constexpr std::size_t chunk = 64;

struct Stack {
    std::array<std::array<vec4, chunk>, maxStack> entries;  // those above `top` are not read
    std::size_t top = 0;
    std::size_t count;

    explicit Stack(std::size_t places) : count(places) { std::ranges::fill(row(0), vec4(0)); }
    std::span<vec4> row(std::size_t i) { return std::span(entries[i]).first(count); }
};

void execute(const Paints& paints, const Instruction& in, const Row& row, const MaterialFunction& materials,
             Stack& stack) {
    switch (in.op) {
        case Op::Push:
            std::ranges::fill(stack.row(++stack.top), vec4(0));
            return;
        case Op::Pop:
        case Op::PopMaskLuminance:
        case Op::PopMaskLinear:
        case Op::PopMaskAlpha: {
            const std::span<vec4> source = stack.row(stack.top--), below = stack.row(stack.top);
            for (std::size_t i = 0; i < stack.count; ++i)
                below[i] = in.op == Op::Pop ? blend(in.blend, source[i] * in.opacity, below[i])
                                            : below[i] * maskFactor(in.op, source[i]);
            return;
        }
        default: {
            std::array<vec4, chunk> layer;
            const std::span<vec4> source = std::span(layer).first(stack.count), below = stack.row(stack.top);
            layerColors(paints, in, row, materials, source);
            for (std::size_t i = 0; i < stack.count; ++i)
                below[i] = over(source[i] * in.opacity, below[i]);
        }
    }
}

bool hasGradients(const AssetView& asset) {
    for (const Paint& paint : asset.paints)
        if (isProgram(paint))
            for (std::uint32_t i = paint[0]; i < paint[0] + paint[1]; ++i)
                if (const Op op = recordAt<Instruction>(asset.data, i).op;
                    op == Op::Linear || op == Op::Radial)
                    return true;
    return false;
}

}  // namespace

Paints::Paints(const AssetView& asset) : asset_(asset), images_(asset) {
    if (!hasGradients(asset))
        return;
    // All texels as if they were stops: gradients of a hostile file may overlap as they like.
    stopColors_.reserve(asset.data.size());
    for (std::size_t i = 0; i < asset.data.size(); ++i) {
        const auto stop = recordAt<GradientStop>(asset.data, i);
        stopColors_.push_back(vec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0f);
    }
}

vec4 Paints::color(std::uint32_t paint, const PaintPlace& place, const MaterialFunction& materials) const {
    vec4 color;
    colors(paint, place, vec2(0), {&color, 1}, materials);
    return color;
}

void Paints::colors(std::uint32_t paint, const PaintPlace& place, vec2 step, std::span<vec4> colors,
                    const MaterialFunction& materials) const {
    const Paint& p = asset_.paints[paint];
    if (!isProgram(p)) {
        std::ranges::fill(colors, floats(p));
        return;
    }
    Row row{place, step};
    for (std::size_t done = 0; done < colors.size(); done += chunk) {
        Stack stack(std::min(chunk, colors.size() - done));
        row.first.point = place.point + float(done) * step;
        for (std::uint32_t i = p[0]; i < p[0] + p[1]; ++i)
            execute(*this, recordAt<Instruction>(asset_.data, i), row, materials, stack);
        std::ranges::copy(stack.row(stack.top), colors.begin() + std::ptrdiff_t(done));
    }
}

}  // namespace vtm::asset

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

bool isTransparent(Float4 c) { return c[0] == 0 && c[1] == 0 && c[2] == 0 && c[3] == 0; }

Float4 floats(const Texel& t) { return float4(std::bit_cast<vec4>(t)); }

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

/// Of a layer that is not solid.
void layerColors(const Paints& paints, const Instruction& in, const Row& row,
                 const MaterialFunction& materials, std::span<Float4> colors) {
    const std::span<const Texel> data = paints.asset().data;
    const auto each = [&](auto&& color) {
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = float4(color(row.point(i)));
    };
    switch (in.op) {
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

/// A level is of one colour, whatever stands in its row, until something else is drawn into it.
struct Stack {
    std::span<Float4> lowest;
    std::array<std::array<Float4, longestRow>, maxStack> others;
    std::array<Float4, maxStack> color;
    std::array<bool, maxStack> isOneColor;
    std::size_t top = 0;

    explicit Stack(std::span<Float4> colors) : lowest(colors) { clear(); }
    void clear() {
        color[top] = Float4{};
        isOneColor[top] = true;
    }
    std::span<Float4> row(std::size_t i) {
        return i == 0 ? lowest : std::span(others[i]).first(lowest.size());
    }
    /// The row with what is in the level.
    std::span<Float4> filledRow(std::size_t i) {
        if (isOneColor[i])
            std::ranges::fill(row(i), color[i]);
        isOneColor[i] = false;
        return row(i);
    }
};

Float4 popped(const Instruction& in, Float4 source, Float4 below) {
    if (in.op != Op::Pop)
        return below * maskFactor(in.op, toVec4(source));
    source *= in.opacity;
    return in.blend == Blend::Normal ? over(source, below)
                                     : float4(blend(in.blend, toVec4(source), toVec4(below)));
}

void pop(const Instruction& in, Stack& stack) {
    const std::size_t top = stack.top--, below = stack.top;
    if (stack.isOneColor[top] && stack.isOneColor[below]) {
        stack.color[below] = popped(in, stack.color[top], stack.color[below]);
        return;
    }
    const std::span<Float4> source = stack.filledRow(top), target = stack.filledRow(below);
    for (std::size_t i = 0; i < target.size(); ++i)
        target[i] = popped(in, source[i], target[i]);
}

void drawSolid(Float4 source, Stack& stack) {
    if (stack.isOneColor[stack.top])
        stack.color[stack.top] = over(source, stack.color[stack.top]);
    else
        for (Float4& below : stack.row(stack.top))
            below = over(source, below);
}

void drawLayer(const Paints& paints, const Instruction& in, const Row& row, const MaterialFunction& materials,
               Stack& stack) {
    if (in.op == Op::Solid)
        return drawSolid(floats(paints.asset().data[in.argument]) * in.opacity, stack);
    const std::span<Float4> below = stack.row(stack.top);
    const float opacity = in.opacity;
    if (stack.isOneColor[stack.top]) {
        layerColors(paints, in, row, materials, below);
        stack.isOneColor[stack.top] = false;
        const Float4 ground = stack.color[stack.top];
        if (opacity != 1 || !isTransparent(ground))
            for (Float4& color : below)
                color = over(color * opacity, ground);
        return;
    }
    std::array<Float4, longestRow> layer;
    const std::span<Float4> source = std::span(layer).first(below.size());
    layerColors(paints, in, row, materials, source);
    for (std::size_t i = 0; i < below.size(); ++i)
        below[i] = over(source[i] * opacity, below[i]);
}

void execute(const Paints& paints, const Instruction& in, const Row& row, const MaterialFunction& materials,
             Stack& stack) {
    switch (in.op) {
        case Op::Push:
            ++stack.top;
            return stack.clear();
        case Op::Pop:
        case Op::PopMaskLuminance:
        case Op::PopMaskLinear:
        case Op::PopMaskAlpha:
            return pop(in, stack);
        default:
            return drawLayer(paints, in, row, materials, stack);
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
    Float4 color;
    colors(paint, place, vec2(0), {&color, 1}, materials);
    return toVec4(color);
}

void Paints::colors(std::uint32_t paint, const PaintPlace& place, vec2 step, std::span<Float4> colors,
                    const MaterialFunction& materials) const {
    const Paint& p = asset_.paints[paint];
    if (!isProgram(p)) {
        std::ranges::fill(colors, floats(p));
        return;
    }
    Row row{place, step};
    for (std::size_t done = 0; done < colors.size(); done += longestRow) {
        Stack stack(colors.subspan(done, std::min(longestRow, colors.size() - done)));
        row.first.point = place.point + float(done) * step;
        for (std::uint32_t i = p[0]; i < p[0] + p[1]; ++i)
            execute(*this, recordAt<Instruction>(asset_.data, i), row, materials, stack);
        stack.filledRow(0);
    }
}

}  // namespace vtm::asset

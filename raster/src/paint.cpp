#include "raster/src/paint.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include <glm/common.hpp>

#include <vtm/limits/limits.hpp>
#include "raster/blend.hpp"
#include "raster/src/gradient.hpp"

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

    const glm::mat2& pixel() const { return first.pixel; }
    vec2 point(std::size_t i) const { return first.point + float(i) * step; }
    Row part(std::size_t from, std::size_t) const {
        return {{first.point + float(from) * step, first.pixel}, step};
    }
};

std::optional<Float4> linear(const GradientView& gradient, const Row& row, std::span<Float4> colors) {
    return linearColors(gradient, row.first.point, row.step, row.first.pixel, colors);
}
std::optional<Float4> radial(const GradientView& gradient, const Row& row, std::span<Float4> colors) {
    return radialColors(gradient, row.first.point, row.step, row.first.pixel, colors);
}

void read(ImageReader& image, const Row& row, std::span<Float4> colors) {
    image.colors(row.first.point, row.step, colors);
}

/// Places anywhere.
struct Scattered {
    std::span<const vec2> points;
    glm::mat2 sides;

    const glm::mat2& pixel() const { return sides; }
    vec2 point(std::size_t i) const { return points[i]; }
    Scattered part(std::size_t from, std::size_t count) const { return {points.subspan(from, count), sides}; }
};

std::optional<Float4> linear(const GradientView& gradient, const Scattered& places,
                             std::span<Float4> colors) {
    return linearColors(gradient, places.points, places.sides, colors);
}
std::optional<Float4> radial(const GradientView& gradient, const Scattered& places,
                             std::span<Float4> colors) {
    return radialColors(gradient, places.points, places.sides, colors);
}

void read(ImageReader& image, const Scattered& places, std::span<Float4> colors) {
    for (std::size_t i = 0; i < colors.size(); ++i)
        colors[i] = image.color(places.point(i));
}

/// Of a layer that is not solid; one colour instead where it is seen to be the same everywhere.
template <class Places>
std::optional<Float4> layerColors(const Paints& paints, const Instruction& in, const Places& places,
                                  const MaterialFunction& materials, std::span<Float4> colors) {
    const std::span<const Texel> data = paints.asset().data;
    switch (in.op) {
        case Op::Image: {
            ImageReader reader(paints.images(), recordAt<ImageFill>(data, in.argument), places.pixel());
            read(reader, places, colors);
            return {};
        }
        case Op::Material: {
            const auto fill = recordAt<MaterialFill>(data, in.argument);
            for (std::size_t i = 0; i < colors.size(); ++i)
                colors[i] = float4(materialColor(fill, places.point(i), materials));
            return {};
        }
        case Op::Linear:
            return linear({data, paints.stopColors(), in.argument}, places, colors);
        default:
            return radial({data, paints.stopColors(), in.argument}, places, colors);
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
    else if (!isTransparent(source))
        for (Float4& below : stack.row(stack.top))
            below = over(source, below);
}

template <class Places>
void drawLayer(const Paints& paints, const Instruction& in, const Places& places,
               const MaterialFunction& materials, Stack& stack) {
    if (in.op == Op::Solid)
        return drawSolid(floats(paints.asset().data[in.argument]) * in.opacity, stack);
    const std::span<Float4> below = stack.row(stack.top);
    const float opacity = in.opacity;
    if (stack.isOneColor[stack.top]) {
        if (const auto color = layerColors(paints, in, places, materials, below))
            return drawSolid(*color * opacity, stack);
        stack.isOneColor[stack.top] = false;
        const Float4 ground = stack.color[stack.top];
        if (opacity != 1 || !isTransparent(ground))
            for (Float4& color : below)
                color = over(color * opacity, ground);
        return;
    }
    std::array<Float4, longestRow> layer;
    const std::span<Float4> source = std::span(layer).first(below.size());
    if (const auto color = layerColors(paints, in, places, materials, source))
        return drawSolid(*color * opacity, stack);
    for (std::size_t i = 0; i < below.size(); ++i)
        below[i] = over(source[i] * opacity, below[i]);
}

template <class Places>
void execute(const Paints& paints, const Instruction& in, const Places& places,
             const MaterialFunction& materials, Stack& stack) {
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
            return drawLayer(paints, in, places, materials, stack);
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

Paints::Paints(const AssetView& asset) : Paints(asset, std::make_shared<const Images>(asset)) {}

Paints::Paints(const AssetView& asset, std::shared_ptr<const Images> images) : asset_(asset) {
    auto made = std::make_shared<Made>(asset, std::move(images));
    if (hasGradients(asset)) {
        // All texels as if they were stops: gradients of a hostile file may overlap as they like.
        made->stopColors.reserve(asset.data.size());
        for (std::size_t i = 0; i < asset.data.size(); ++i) {
            const auto stop = recordAt<GradientStop>(asset.data, i);
            made->stopColors.push_back(vec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) /
                                       65535.0f);
        }
    }
    made_ = std::move(made);
}

Paints Paints::from(std::uint32_t first) const {
    Paints paints = *this;
    paints.asset_.paints = asset_.paints.subspan(first);
    paints.first_ += first;
    return paints;
}

vec4 Paints::color(std::uint32_t paint, const PaintPlace& place, const MaterialFunction& materials) const {
    Float4 color;
    colors(paint, place, vec2(0), {&color, 1}, materials);
    return toVec4(color);
}

template <class Places>
void Paints::run(const Paint& program, Places places, std::span<Float4> colors,
                 const MaterialFunction& materials) const {
    for (std::size_t done = 0; done < colors.size(); done += longestRow) {
        const std::size_t count = std::min(longestRow, colors.size() - done);
        Stack stack(colors.subspan(done, count));
        const Places part = places.part(done, count);
        for (std::uint32_t i = program[0]; i < program[0] + program[1]; ++i) {
            limits::check();
            execute(*this, recordAt<Instruction>(asset_.data, i), part, materials, stack);
        }
        stack.filledRow(0);
    }
}

void Paints::colors(std::uint32_t paint, const PaintPlace& place, vec2 step, std::span<Float4> colors,
                    const MaterialFunction& materials) const {
    const Paint& p = asset_.paints[paint];
    if (isProgram(p))
        run(p, Row{place, step}, colors, materials);
    else
        std::ranges::fill(colors, floats(p));
}

void Paints::colors(std::uint32_t paint, std::span<const vec2> points, const glm::mat2& pixel,
                    std::span<Float4> colors, const MaterialFunction& materials) const {
    const Paint& p = asset_.paints[paint];
    if (isProgram(p))
        run(p, Scattered{points, pixel}, colors, materials);
    else
        std::ranges::fill(colors, floats(p));
}

}  // namespace vtm::asset

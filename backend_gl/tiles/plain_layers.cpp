#include "backend_gl/tiles/plain_layers.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "raster/blend.hpp"

namespace vtm::gl::plain {

using asset::Blend;
using asset::Gradient;
using asset::Instruction;
using asset::Op;
using glm::dvec4;

namespace {

/// Of a paint. A program of more takes longer to make than to run.
constexpr std::size_t maxLayers = 32;
/// A ramp that differs by less near a tile has one colour there.
constexpr double sameColor = 0.5 * maxTableError;

/// Premultiplied.
dvec4 over(const dvec4& source, const dvec4& backdrop) { return source + (1 - source.a) * backdrop; }
bool isClear(const dvec4& c) { return c == dvec4(0); }

}  // namespace

dvec4 Step::operator()(const dvec4& c) const {
    switch (kind) {
        case Kind::Scale:
            return c * color.a;
        case Kind::Onto:
            return over(c, color);
        case Kind::Under:
            return over(color, c);
        case Kind::Mix:
            return dvec4(asset::blend(blend, glm::vec4(c), glm::vec4(color)));
        case Kind::MixOn:
            return dvec4(asset::blend(blend, glm::vec4(color), glm::vec4(c)));
        default:
            return color * double(asset::maskFactor(mask, glm::vec4(c)));
    }
}

dvec4 PlainLayer::at(double u) const {
    dvec4 c = ramp->at(u);
    for (const Step& step : steps)
        c = step(c);
    return c;
}

void PlainLayer::add(const Step& step) {
    if (isColor())
        color = step(color);
    else
        steps.push_back(step);
}

namespace {

/// A layer over others. A colour is the lowest layer or part of one.
void put(Layers& layers, PlainLayer layer) {
    if (layer.isColor() ? layer.color.a >= 1 : layer.isOpaque)
        layers.clear();
    if (layer.isColor() && !layers.empty()) {
        layers.back().add({Step::Kind::Under, layer.color});
        return;
    }
    if (layers.size() == 1 && layers[0].isColor()) {
        layer.isOpaque = layer.isOpaque || layers[0].color.a >= 1;
        layer.add({Step::Kind::Onto, layers[0].color});
        layers.clear();
    }
    if (!layer.isColor() || !isClear(layer.color))
        layers.push_back(std::move(layer));
}

/// The layer, if it is one, or nothing, as a colour.
std::optional<PlainLayer> onlyLayer(const Layers& layers) {
    if (layers.size() > 1)
        return std::nullopt;
    return layers.empty() ? PlainLayer() : layers[0];
}

/// Two of which one is a colour: the other one with a step.
std::optional<PlainLayer> joined(const Layers& source, const Layers& backdrop, Step ofSource,
                                 Step ofBackdrop) {
    std::optional<PlainLayer> above = onlyLayer(source), below = onlyLayer(backdrop);
    if (!above || !below || (!above->isColor() && !below->isColor()))
        return std::nullopt;
    const bool isOpaque = ofSource.kind == Step::Kind::Mix &&
                          (above->isOpaque || below->isOpaque || (above->isColor() && above->color.a >= 1) ||
                           (below->isColor() && below->color.a >= 1));
    PlainLayer& kept = below->isColor() ? *above : *below;
    Step& step = below->isColor() ? ofSource : ofBackdrop;
    step.color = below->isColor() ? below->color : above->color;
    kept.isOpaque = isOpaque;
    kept.add(step);
    return kept;
}

/// Runs a program near a tile.
class PlainProgram {
public:
    PlainProgram(const asset::AssetView& asset, const TileFrame& frame) : asset_(asset), frame_(frame) {}

    std::optional<Layers> run(const asset::Paint& program) {
        for (std::uint32_t i = 0; i < program[1]; ++i) {
            limits::check();
            if (!execute(asset::recordAt<Instruction>(asset_.data, program[0] + i)) ||
                stack_.back().size() > maxLayers)
                return std::nullopt;
        }
        return std::move(stack_.back());
    }

private:
    bool execute(const Instruction& in) {
        switch (in.op) {
            case Op::Push:
                stack_.emplace_back();
                return true;
            case Op::Pop:
                return pop(in);
            case Op::PopMaskLuminance:
            case Op::PopMaskLinear:
            case Op::PopMaskAlpha:
                return popMask(in);
            case Op::Solid: {
                PlainLayer layer;
                layer.color = double(in.opacity) * dvec4(std::bit_cast<glm::vec4>(asset_.data[in.argument]));
                put(stack_.back(), std::move(layer));
                return true;
            }
            case Op::Linear:
            case Op::Radial:
                return in.opacity == 0 || drawGradient(in);
            default:
                return in.opacity == 0;
        }
    }

    Layers popped() {
        Layers layers = std::move(stack_.back());
        stack_.pop_back();
        return layers;
    }

    bool pop(const Instruction& in) {
        Layers source = popped();
        Layers& backdrop = stack_.back();
        if (in.opacity != 1) {
            if (source.size() > 1)
                return false;
            if (!source.empty())
                scale(source[0], double(in.opacity));
        }
        if (in.blend == Blend::Normal) {
            for (PlainLayer& layer : source)
                put(backdrop, std::move(layer));
            return true;
        }
        return replace(
            joined(source, backdrop, {Step::Kind::Mix, {}, in.blend}, {Step::Kind::MixOn, {}, in.blend}));
    }

    bool popMask(const Instruction& in) {
        const Layers mask = popped();
        Layers& masked = stack_.back();
        const std::optional<PlainLayer> only = onlyLayer(mask);
        if (!only)
            return false;
        if (only->isColor()) {
            const double factor = double(asset::maskFactor(in.op, glm::vec4(only->color)));
            if (factor == 0)
                masked.clear();
            if (masked.empty() || factor == 1)
                return true;
            if (masked.size() > 1)
                return false;
            scale(masked[0], factor);
            return true;
        }
        Step step{Step::Kind::Mask, {}};
        step.mask = in.op;
        return masked.empty() || (masked[0].isColor() && replace(joined(mask, masked, step, step)));
    }

    static void scale(PlainLayer& layer, double factor) {
        layer.isOpaque = layer.isOpaque && factor >= 1;
        layer.add({Step::Kind::Scale, dvec4(factor)});
    }

    bool replace(std::optional<PlainLayer> layer) {
        if (!layer)
            return false;
        stack_.back().clear();
        put(stack_.back(), std::move(*layer));
        return true;
    }

    bool drawGradient(const Instruction& in) {
        const auto gradient = asset::recordAt<Gradient>(asset_.data, in.argument);
        if (gradient.stopCount > maxPlainStops)
            return false;
        const std::optional<Place> place = placeOf(gradient, in.op == Op::Radial, frame_);
        if (!place)
            return false;
        PlainLayer layer;
        const Interval t = place->over(0.5 * frame_.pixel);
        layer.range = {(place->isRadial ? std::max(t.from, 0.0) : t.from) - place->start,
                       t.to - place->start};
        layer.ramp = std::make_shared<const Ramp>(asset_.data, in.argument, gradient);
        layer.place = *place;
        const std::optional<std::vector<double>> corners =
            layer.ramp->corners(layer.range.from, layer.range.to);
        if (!corners)
            return false;
        const dvec4 color = layer.ramp->at(0.5 * (layer.range.from + layer.range.to));
        const auto isSame = [&](double u) { return isAlike(layer.ramp->at(u), color, sameColor); };
        if (isSame(layer.range.from) && isSame(layer.range.to) &&
            std::ranges::all_of(*corners,
                                [&](double u) { return isSame(u - besideStop) && isSame(u + besideStop); })) {
            layer.ramp.reset();
            layer.color = color;
        } else {
            layer.isOpaque = layer.ramp->isOpaque();
        }
        if (in.opacity != 1)
            scale(layer, double(in.opacity));
        put(stack_.back(), std::move(layer));
        return true;
    }

    const asset::AssetView& asset_;
    TileFrame frame_;
    std::vector<Layers> stack_{1};
};

}  // namespace

std::optional<Layers> plainLayers(const asset::AssetView& asset, const asset::Paint& program,
                                  const TileFrame& frame) {
    return PlainProgram(asset, frame).run(program);
}

}  // namespace vtm::gl::plain

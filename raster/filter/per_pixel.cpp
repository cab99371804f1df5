// Operations that compute each pixel from the same pixel of their inputs.

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/blend.hpp"
#include "raster/filter/curves.hpp"
#include "raster/filter/operations.hpp"
#include "raster/filter_tables.hpp"

namespace vtm::asset {

namespace {

/// combine(colour of the first input, of the second) for each pixel of a box, beyond which the result is
/// transparent.
template <class Combine>
Layer combined(const FilterStep& step, const PixelBox& box, Combine combine) {
    Layer result = Layer::unwritten(box.intersection(step.box), step.linear);
    byRows(result.box, [&](const PixelBox& part) {
        LayerRows first(*step.inputs[0], part), second(*step.inputs[1], part);
        for (int y = part.min.y; y < part.max.y; ++y) {
            const Float4* a = first(y);
            std::transform(a, a + part.width(), second(y), result.row(y), combine);
        }
    });
    return result;
}

/// Of all inputs.
PixelBox joinedBox(const FilterStep& step) {
    PixelBox box;
    for (const Layer* input : step.inputs)
        box = box.joined(input->box);
    return box;
}

/// The input's pixels changed; `box`: beyond it the result is transparent.
template <class Change>
Layer recoloured(const FilterStep& step, const PixelBox& box, Change change) {
    return changed(*step.inputs[0], box.intersection(step.box), step.linear, change);
}

Float4 alphas(Float4 c) { return Float4{c[3], c[3], c[3], c[3]}; }

/// A straight colour of the parameters, premultiplied in the step's colour space.
Float4 colorFrom(const FilterStep& step, std::size_t first) {
    const FilterParameters& p = step.parameters;
    Float4 color{p[first], p[first + 1], p[first + 2], p[first + 3]};
    if (step.linear)
        for (int c = 0; c < 3; ++c)
            color[c] = decodingCurve()(color[c]);
    return premultiplied(color);
}

/// One channel's function.
class Transfer {
public:
    /// Its parameters begin at `next`, which is moved behind them.
    Transfer(const FilterParameters& parameters, std::size_t& next)
        : kind_(TransferKind(int(parameters[next]))),
          count_(std::size_t(parameters[next + 1])),
          values_(parameters.from(next + 2)) {
        next += 2 + count_;
    }

    float operator()(float c) const {
        switch (kind_) {
            case TransferKind::Table:
                return unit(table(c));
            case TransferKind::Discrete:
                return count_ == 0 ? c : unit(values_[std::min(std::size_t(c * float(count_)), count_ - 1)]);
            case TransferKind::Linear:
                return unit(values_[0] * c + values_[1]);
            case TransferKind::Gamma:
                return unit(values_[0] * std::pow(c, values_[1]) + values_[2]);
        }
        return c;
    }

private:
    float table(float c) const {
        if (count_ == 0)
            return c;
        const float at = c * float(count_ - 1);
        const std::size_t k = std::min(std::size_t(at), count_ - 1), next = std::min(k + 1, count_ - 1);
        return values_[k] + (at - float(k)) * (values_[next] - values_[k]);
    }

    TransferKind kind_;
    std::size_t count_;
    FilterParameters values_;
};

}  // namespace

Layer blendLayers(const FilterStep& step) {
    const auto mode = Blend(int(step.parameters[0]));
    const PixelBox box = joinedBox(step);
    const auto alone = [](Float4 a, Float4 b) { return a * (1 - alphas(b)) + b * (1 - alphas(a)); };
    switch (mode) {  // those of SVG 1.1 with all channels at once
        case Blend::Normal:
            return combined(step, box, [](Float4 a, Float4 b) { return over(a, b); });
        case Blend::Multiply:
            return combined(step, box, [=](Float4 a, Float4 b) { return a * b + alone(a, b); });
        case Blend::Screen:
            return combined(step, box, [](Float4 a, Float4 b) { return a + b - a * b; });
        case Blend::Darken:
            return combined(step, box, [=](Float4 a, Float4 b) {
                const Float4 s = a * alphas(b), t = b * alphas(a);
                return (s < t ? s : t) + alone(a, b);
            });
        case Blend::Lighten:
            return combined(step, box, [=](Float4 a, Float4 b) {
                const Float4 s = a * alphas(b), t = b * alphas(a);
                return (s > t ? s : t) + alone(a, b);
            });
        default:
            return combined(step, box,
                            [mode](Float4 a, Float4 b) { return float4(blend(mode, toVec4(a), toVec4(b))); });
    }
}

Layer colorMatrix(const FilterStep& step) {
    Float4 columns[5];
    for (std::size_t column = 0; column < 5; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            columns[column][int(row)] = step.parameters[row * 5 + column];
    const bool showsNothing = !(columns[4][3] > 0);  // of what is transparent
    return recoloured(step, showsNothing ? step.inputs[0]->box : step.box, [&](Float4 c) {
        const Float4 s = straightened(c);
        return premultiplied(
            unit(columns[0] * s[0] + columns[1] * s[1] + columns[2] * s[2] + columns[3] * s[3] + columns[4]));
    });
}

Layer componentTransfer(const FilterStep& step) {
    std::size_t next = 0;
    const Transfer red(step.parameters, next), green(step.parameters, next), blue(step.parameters, next),
        alpha(step.parameters, next);
    return recoloured(step, alpha(0) == 0 ? step.inputs[0]->box : step.box, [&](Float4 c) {
        const Float4 s = unit(straightened(c));
        return premultiplied(Float4{red(s[0]), green(s[1]), blue(s[2]), alpha(s[3])});
    });
}

Layer composite(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const PixelBox &first = step.inputs[0]->box, &second = step.inputs[1]->box, both = joinedBox(step);
    switch (CompositeOp(int(p[0]))) {
        case CompositeOp::Over:
            return combined(step, both, [](Float4 a, Float4 b) { return over(a, b); });
        case CompositeOp::In:
            return combined(step, first.intersection(second),
                            [](Float4 a, Float4 b) { return a * alphas(b); });
        case CompositeOp::Out:
            return combined(step, first, [](Float4 a, Float4 b) { return a * (1 - alphas(b)); });
        case CompositeOp::Atop:
            return combined(step, second,
                            [](Float4 a, Float4 b) { return a * alphas(b) + (1 - alphas(a)) * b; });
        case CompositeOp::Xor:
            return combined(step, both,
                            [](Float4 a, Float4 b) { return a * (1 - alphas(b)) + (1 - alphas(a)) * b; });
        case CompositeOp::Lighter:
            return combined(step, both, [](Float4 a, Float4 b) { return unit(a + b); });
        case CompositeOp::Arithmetic:
            break;
    }
    const float k1 = p[1], k2 = p[2], k3 = p[3], k4 = p[4];
    return combined(step, k4 > 0 ? step.box : both, [=](Float4 a, Float4 b) {
        const Float4 c = unit(k1 * a * b + k2 * a + k3 * b + k4), alpha = alphas(c);
        return c < alpha ? c : alpha;
    });
}

Layer merge(const FilterStep& step) {
    Layer result(joinedBox(step).intersection(step.box), step.linear);
    for (const Layer* input : step.inputs) {
        const PixelBox both = result.box.intersection(input->box);
        eachRow(both, [&](int y) {
            const Float4* from = input->row(y) + (both.min.x - input->box.min.x);
            Float4* to = result.row(y) + (both.min.x - result.box.min.x);
            for (int x = 0; x < both.width(); ++x)
                to[x] = over(from[x], to[x]);
        });
    }
    return result;
}

Layer flood(const FilterStep& step) {
    Layer result = Layer::unwritten(step.box, step.linear);
    std::ranges::fill(result.pixels, colorFrom(step, 0));
    return result;
}

// ---- Drop shadow ----------------------------------------------------------------------------------

namespace {

/// A step on one layer, with other parameters.
Layer withParameters(const FilterStep& step, const Layer& input, const PixelBox& box,
                     Layer (*operation)(const FilterStep&), std::initializer_list<float> values) {
    std::vector<std::uint32_t> words;
    for (const float value : values)
        words.push_back(std::bit_cast<std::uint32_t>(value));
    const Layer* const inputs[] = {&input};
    FilterStep inner = step;
    inner.parameters = FilterParameters(words);
    inner.inputs = inputs;
    inner.box = box;
    return operation(inner);
}

}  // namespace

Layer dropShadow(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const PixelBox moved = step.box.grown({blurReach(p[2] * step.scale.x), blurReach(p[3] * step.scale.y)});
    const Layer alpha = alphaOf(*step.inputs[0]);
    const Layer shifted = withParameters(step, alpha, moved, offset, {p[0], p[1]});
    const Layer blurred = withParameters(step, shifted, step.box, gaussianBlur, {p[2], p[3]});
    const Float4 color = colorFrom(step, 4);
    const Layer shadow = changed(blurred, blurred.box, step.linear, [&](Float4 c) { return color * c[3]; });
    const Layer* const both[] = {&shadow, step.inputs[0]};
    FilterStep merged = step;
    merged.inputs = both;
    return merge(merged);
}

}  // namespace vtm::asset

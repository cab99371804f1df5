#include <vtm/raster/evaluate.hpp>

#include <algorithm>
#include <vector>

#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "raster/src/blend.hpp"
#include "raster/src/draw_map.hpp"
#include "raster/src/float4.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/rough.hpp"

namespace vtm::asset {

namespace {

using glm::vec2;
using glm::vec4;
using image::Raster;

vec4 load(const float* pixel) { return glm::make_vec4(pixel); }

void store(float* pixel, vec4 color) { std::copy_n(glm::value_ptr(color), 4, pixel); }

/// Share of each pixel of a box that a map covers.
struct Mask {
    PixelBox box;
    Raster coverage;

    float at(int x, int y) const { return unit(coverage.pixel(x - box.min.x, y - box.min.y)[0]); }
};

Mask coverageOf(const Paints& paints, const Map& map, const View& view) {
    const PixelBox box = pixelsOf(view, placeOf(map));
    const View cropped = crop(view, box);
    Mask mask{box, Raster(cropped.width, cropped.height)};
    addCoverage(paints, map, cropped, mask.coverage);
    return mask;
}

/// Pixels to places of the picture.
class PixelCentres {
public:
    explicit PixelCentres(const View& view)
        : linear_(view.toPixels[0], view.toPixels[1]), origin_(view.toPixels[2]) {
        linear_ = glm::inverse(linear_);
    }
    PaintPlace operator()(int x, int y) const {
        return {vec2(linear_ * (glm::dvec2(x + 0.5, y + 0.5) - origin_)), glm::mat2(linear_)};
    }

private:
    glm::dmat2 linear_;
    glm::dvec2 origin_;
};

void fillMask(const Paints& paints, const Command& command, const View& view,
              const MaterialFunction& materials, Raster& top) {
    const Mask mask = coverageOf(paints, paints.asset().maps[command.map], view);
    const PixelCentres centre(view);
    for (int y = mask.box.min.y; y < mask.box.max.y; ++y)
        for (int x = mask.box.min.x; x < mask.box.max.x; ++x) {
            const float coverage = mask.at(x, y);
            if (coverage == 0)
                continue;
            const vec4 source = paints.color(command.paint, centre(x, y), materials) * coverage;
            store(top.pixel(x, y), over(source, load(top.pixel(x, y))));
        }
}

void clipMask(const Paints& paints, const Command& command, const View& view, Raster& top) {
    const Mask mask = coverageOf(paints, paints.asset().maps[command.map], view);
    for (int y = 0; y < top.height; ++y)
        for (int x = 0; x < top.width; ++x) {
            const bool inside =
                x >= mask.box.min.x && x < mask.box.max.x && y >= mask.box.min.y && y < mask.box.max.y;
            store(top.pixel(x, y), load(top.pixel(x, y)) * (inside ? mask.at(x, y) : 0.0f));
        }
}

/// What the whole picture on top of the stack does to one below.
template <class Combine>
void combine(const Raster& source, Raster& top, Combine&& combineColors) {
    for (std::size_t i = 0; i < top.rgba.size(); i += 4)
        store(&top.rgba[i], combineColors(load(&source.rgba[i]), load(&top.rgba[i])));
}

Op maskOp(Command::Kind kind) {
    switch (kind) {
        case Command::Kind::PopMaskLuminance:
            return Op::PopMaskLuminance;
        case Command::Kind::PopMaskLinear:
            return Op::PopMaskLinear;
        default:
            return Op::PopMaskAlpha;
    }
}

void pop(const Command& command, std::vector<Raster>& stack) {
    const Raster source = std::move(stack.back());
    stack.pop_back();
    if (command.kind == Command::Kind::Pop)
        combine(source, stack.back(),
                [&](vec4 s, vec4 b) { return blend(command.blend, s * command.opacity, b); });
    else
        combine(source, stack.back(),
                [&](vec4 s, vec4 b) { return b * maskFactor(maskOp(command.kind), s); });
}

void execute(const Paints& paints, const Command& command, const View& view,
             const MaterialFunction& materials, int levels, std::vector<Raster>& stack) {
    switch (command.kind) {
        case Command::Kind::DrawMap:
            return addColors(paints, paints.asset().maps[command.map], view, materials, levels, stack.back());
        case Command::Kind::FillMask:
            return fillMask(paints, command, view, materials, stack.back());
        case Command::Kind::ClipMask:
            return clipMask(paints, command, view, stack.back());
        case Command::Kind::Push:
            stack.emplace_back(view.width, view.height);
            return;
        default:
            return pop(command, stack);
    }
}

/// Rough pixels so many levels finer.
Raster drawn(const Paints& paints, const View& view, const MaterialFunction& materials, int levels) {
    validate(view);
    std::vector<Raster> stack(1, Raster(view.width, view.height));
    for (const Command& command : paints.asset().commands)
        execute(paints, command, view, materials, levels, stack);
    std::ranges::transform(stack.back().rgba, stack.back().rgba.begin(), unit);
    return std::move(stack.back());
}

}  // namespace

Raster evaluate(const AssetView& asset, const View& view, const MaterialFunction& materials) {
    return evaluate(Paints(asset), view, materials);
}

Raster evaluateAsShaders(const AssetView& asset, const View& view, const MaterialFunction& materials) {
    return drawn(Paints(asset), view, materials, 0);
}

Raster evaluate(const Paints& paints, const View& view, const MaterialFunction& materials) {
    return drawn(paints, view, materials, finerLevels(paints.asset(), view));
}

}  // namespace vtm::asset

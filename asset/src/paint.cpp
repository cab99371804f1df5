#include "asset/src/paint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

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

// ---- Images ---------------------------------------------------------------------------------------

vec4 imagePixel(const image::Bitmap& bitmap, int x, int y) {
    x = std::clamp(x, 0, bitmap.width - 1);
    y = std::clamp(y, 0, bitmap.height - 1);
    const std::uint8_t* p = &bitmap.rgba[(std::size_t(y) * std::size_t(bitmap.width) + std::size_t(x)) * 4];
    const vec4 c = vec4(p[0], p[1], p[2], p[3]) / 255.0f;
    return {glm::vec3(c) * c.a, c.a};
}

/// Premultiplied neighbours are interpolated, so that transparent pixels lend no colour.
vec4 imageColor(const AssetView& asset, const ImageFill& fill, vec2 point) {
    const image::Bitmap& bitmap = asset.images[fill.image];
    // Keeps the conversion to int defined, for what is not a number too; beyond the border the edge goes
    // on anyway.
    const vec2 place = applyMatrix(fill.matrix, point);
    vec2 p(std::fmax(-1.0f, std::fmin(place.x, float(bitmap.width) + 1)),
           std::fmax(-1.0f, std::fmin(place.y, float(bitmap.height) + 1)));
    if (fill.bilinear == 0)
        return imagePixel(bitmap, int(std::floor(p.x)), int(std::floor(p.y)));
    p -= 0.5f;
    const vec2 corner = glm::floor(p), f = p - corner;
    const int x = int(corner.x), y = int(corner.y);
    const vec4 top = glm::mix(imagePixel(bitmap, x, y), imagePixel(bitmap, x + 1, y), f.x);
    const vec4 bottom = glm::mix(imagePixel(bitmap, x, y + 1), imagePixel(bitmap, x + 1, y + 1), f.x);
    return glm::mix(top, bottom, f.y);
}

// ---- Materials ------------------------------------------------------------------------------------

vec4 materialColor(const MaterialFill& fill, vec2 point, const MaterialFunction& materials) {
    if (!materials)
        return {fill.fallback[0], fill.fallback[1], fill.fallback[2], fill.fallback[3]};
    return glm::clamp(materials(fill.material, applyMatrix(fill.matrix, point)), 0.0f, 1.0f);
}

// ---- Programs -------------------------------------------------------------------------------------

vec4 layerColor(const AssetView& asset, const Instruction& in, vec2 point,
                const MaterialFunction& materials) {
    switch (in.op) {
        case Op::Solid:
            return floats(asset.data[in.argument]);
        case Op::Image:
            return imageColor(asset, recordAt<ImageFill>(asset.data, in.argument), point);
        case Op::Material:
            return materialColor(recordAt<MaterialFill>(asset.data, in.argument), point, materials);
        case Op::Linear:
            return linearColor({asset.data, in.argument}, point);
        default:
            return radialColor({asset.data, in.argument}, point);
    }
}

struct Stack {
    std::array<vec4, maxStack> entries{};
    std::size_t top = 0;

    void push() { entries[++top] = vec4(0); }
    vec4 pop() { return entries[top--]; }
};

void execute(const AssetView& asset, const Instruction& in, vec2 point, const MaterialFunction& materials,
             Stack& stack) {
    switch (in.op) {
        case Op::Push:
            return stack.push();
        case Op::Pop: {
            const vec4 source = stack.pop() * in.opacity;
            vec4& top = stack.entries[stack.top];
            top = blend(in.blend, source, top);
            return;
        }
        case Op::PopMaskLuminance:
        case Op::PopMaskLinear:
        case Op::PopMaskAlpha: {
            const float factor = maskFactor(in.op, stack.pop());
            stack.entries[stack.top] *= factor;
            return;
        }
        default:
            vec4& top = stack.entries[stack.top];
            top = over(layerColor(asset, in, point, materials) * in.opacity, top);
    }
}

vec4 run(const AssetView& asset, std::uint32_t first, std::uint32_t count, vec2 point,
         const MaterialFunction& materials) {
    Stack stack;
    for (std::uint32_t i = 0; i < count; ++i)
        execute(asset, recordAt<Instruction>(asset.data, first + i), point, materials, stack);
    return stack.entries[stack.top];
}

}  // namespace

vec4 paintColor(const AssetView& asset, std::uint32_t paint, vec2 point, const MaterialFunction& materials) {
    const Paint& p = asset.paints[paint];
    return isProgram(p) ? run(asset, p[0], p[1], point, materials) : floats(p);
}

}  // namespace vtm::asset

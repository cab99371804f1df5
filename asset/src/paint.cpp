#include "asset/src/paint.hpp"

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

vec4 layerColor(const Paints& paints, const Instruction& in, const PaintPlace& place,
                const MaterialFunction& materials) {
    const std::span<const Texel> data = paints.asset().data;
    switch (in.op) {
        case Op::Solid:
            return floats(data[in.argument]);
        case Op::Image:
            return paints.images().color(recordAt<ImageFill>(data, in.argument), place.point, place.pixel);
        case Op::Material:
            return materialColor(recordAt<MaterialFill>(data, in.argument), place.point, materials);
        case Op::Linear:
            return linearColor({data, in.argument}, place.point, place.pixel);
        default:
            return radialColor({data, in.argument}, place.point, place.pixel);
    }
}

struct Stack {
    std::array<vec4, maxStack> entries{};
    std::size_t top = 0;

    void push() { entries[++top] = vec4(0); }
    vec4 pop() { return entries[top--]; }
};

void execute(const Paints& paints, const Instruction& in, const PaintPlace& place,
             const MaterialFunction& materials, Stack& stack) {
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
            top = over(layerColor(paints, in, place, materials) * in.opacity, top);
    }
}

}  // namespace

vec4 Paints::color(std::uint32_t paint, const PaintPlace& place, const MaterialFunction& materials) const {
    const Paint& p = asset_.paints[paint];
    if (!isProgram(p))
        return floats(p);
    Stack stack;
    for (std::uint32_t i = p[0]; i < p[0] + p[1]; ++i)
        execute(*this, recordAt<Instruction>(asset_.data, i), place, materials, stack);
    return stack.entries[stack.top];
}

}  // namespace vtm::asset

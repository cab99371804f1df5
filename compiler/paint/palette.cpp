#include "compiler/paint/palette.hpp"

#include <bit>
#include <cmath>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>
#include "compiler/containers/hash.hpp"

namespace vtm::compiler {
namespace {

using asset::Op;

std::string keyOf(const PaintProgram& program) {
    std::string key;
    for (const PaintStep& step : program) {
        key.append(reinterpret_cast<const char*>(&step.instruction), sizeof step.instruction);
        key.append(reinterpret_cast<const char*>(&step.color), sizeof step.color);
    }
    return key;
}

void checkLimits(const PaintProgram& steps) {
    if (steps.size() > asset::maxInstructions)
        throw LimitError("more than " + std::to_string(asset::maxInstructions) +
                         " layers and groups that cannot be folded overlap at one point");
    unsigned depth = 1;
    for (const PaintStep& step : steps) {
        const Op op = step.instruction.op;
        if (op == Op::Push && ++depth > asset::maxStack)
            throw LimitError("groups that cannot be folded are nested more than " +
                             std::to_string(asset::maxStack - 1) + " levels deep");
        depth -=
            op == Op::Pop || op == Op::PopMaskAlpha || op == Op::PopMaskLinear || op == Op::PopMaskLuminance;
    }
}

asset::Paint solidPaint(const Color& c) { return std::bit_cast<asset::Paint>(c); }

asset::Paint programPaint(const PaintProgram& steps, std::vector<asset::Texel>& data) {
    checkLimits(steps);
    const auto first = static_cast<std::uint32_t>(data.size());
    const auto count = static_cast<std::uint32_t>(steps.size());
    data.resize(first + count);
    for (std::uint32_t i = 0; i < count; ++i) {
        asset::Instruction instruction = steps[i].instruction;
        if (instruction.op == Op::Solid) {
            instruction.argument = static_cast<std::uint32_t>(data.size());
            data.push_back(std::bit_cast<asset::Texel>(steps[i].color));
        }
        data[first + i] = std::bit_cast<asset::Texel>(instruction);
    }
    return {first, count, 0, asset::programTag};
}

/// Rounds to `levels` levels from 0 to 1; alpha last, so that colours stay premultiplied.
Color rounded(Color c, float levels) {
    for (float& v : c)
        v = std::floor(v * levels + 0.5f) / levels;
    for (float& v : c)
        v = std::min(v, c[3]);
    return c;
}

/// The finest grid on which the solid colours are few enough, as its number of levels; 0: no grid is
/// needed.
float gridFor(const Palette& palette) {
    if (palette.size() <= maxPaints)
        return 0;
    for (float levels = 4095;; levels = (levels + 1) / 2 - 1) {
        Palette coarse;
        for (PaintId i = 0; i < palette.size() && coarse.size() <= maxPaints; ++i) {
            limits::check();
            const PaintProgram& p = palette[i];
            if (Palette::isConstant(p))
                coarse.solid(rounded(Palette::colorOf(p), levels));
            else
                coarse.add(p);
        }
        if (coarse.size() <= maxPaints)
            return levels;
        if (levels < 8)
            throw LimitError("the picture has more than 65536 distinct region paints that are not solid");
    }
}

}  // namespace

std::size_t StackHash::operator()(const Stack& stack) const {
    std::uint64_t h = stack.size();
    for (std::uint32_t name : stack)
        h = hashCombine(h, name);
    return h;
}

std::uint32_t StackTable::add(const Stack& stack) {
    if (stacks_.empty() && !stack.empty())
        add({});
    const auto [found, isNew] = index_.try_emplace(stack, static_cast<std::uint32_t>(stacks_.size()));
    if (isNew)
        stacks_.push_back(&found->first);
    return found->second;
}

PaintId Palette::intern(const PaintProgram& program) {
    limits::check();
    const auto [found, isNew] = index_.try_emplace(keyOf(program), static_cast<PaintId>(paints_.size()));
    if (isNew)
        paints_.push_back(program);
    return found->second;
}

PaintId Palette::solid(const Color& c) {
    const auto bits = std::bit_cast<std::array<std::uint64_t, 2>>(c);
    for (std::uint64_t key = hashCombine(bits[0], bits[1]);; key = hashCombine(key, 1)) {
        PaintId& id = solids_[key];
        if (id == NumberMap::unknown) {
            id = static_cast<PaintId>(paints_.size());
            paints_.emplace_back(1, PaintStep{asset::Instruction{Op::Solid}, c});
        } else if (std::bit_cast<std::array<std::uint64_t, 2>>(colorOf(paints_[id])) != bits) {
            continue;  // another of the same hash
        }
        return id;
    }
}

PaintId Palette::add(const PaintProgram& program) {
    return isConstant(program) ? solid(colorOf(program)) : intern(program);
}

asset::Paint encodePaint(const PaintProgram& program, std::vector<asset::Texel>& data) {
    return Palette::isConstant(program) ? solidPaint(Palette::colorOf(program)) : programPaint(program, data);
}

std::vector<std::uint16_t> encodePalette(const Palette& palette, asset::Asset& asset, float& error) {
    const limits::Stage stage("encoding paints");
    const float levels = gridFor(palette);
    error = levels > 0 ? 0.5f / levels : 0;
    std::vector<std::uint16_t> indices;
    Palette written;
    asset.paints.push_back(solidPaint({}));
    for (PaintId i = 0; i < palette.size(); ++i) {
        limits::check();
        const PaintProgram& p = palette[i];
        const bool constant = Palette::isConstant(p);
        const Color color = constant ? Palette::colorOf(p) : Color{};
        const PaintId id = !constant    ? written.add(p)
                           : levels > 0 ? written.solid(rounded(color, levels))
                                        : written.solid(color);
        if (id == asset.paints.size())
            asset.paints.push_back(encodePaint(constant ? written[id] : p, asset.data));
        indices.push_back(static_cast<std::uint16_t>(id));
    }
    return indices;
}

}  // namespace vtm::compiler

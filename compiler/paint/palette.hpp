/// \file
/// The paints of regions: constant colours and paint programs, each distinct one once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <vtm/asset/asset.hpp>
#include "compiler/containers/number_map.hpp"

namespace vtm::compiler {

/// A paint of a palette.
using PaintId = std::uint32_t;

/// Premultiplied.
using Color = std::array<float, 4>;

/// Porter-Duff source over.
inline Color over(const Color& s, const Color& d) {
    Color r;
    for (std::size_t i = 0; i < 4; ++i)
        r[i] = s[i] + (1 - s[3]) * d[i];
    return r;
}

/// An instruction and, for Op::Solid, its colour.
struct PaintStep {
    asset::Instruction instruction;
    Color color{};
};
using PaintProgram = std::vector<PaintStep>;

/// While a picture is edited, what a region is made of instead of the colours that follow: the items that
/// show in it, from the bottom, by the names of their layers (LayerNames); or several such
/// lists with `noIndex` between them, for the mean of their paints.
using Stack = std::vector<std::uint32_t>;

struct StackHash {
    std::size_t operator()(const Stack& stack) const;
};

/// The distinct stacks of a block. Stack 0 is empty.
class StackTable {
public:
    StackTable() = default;
    StackTable(StackTable&&) = default;
    StackTable& operator=(StackTable&&) = default;
    StackTable(const StackTable&) = delete;  // stacks_ points into index_

    std::uint32_t add(const Stack& stack);
    std::size_t size() const { return stacks_.size(); }
    const Stack& operator[](std::uint32_t id) const { return *stacks_[id]; }

private:
    std::unordered_map<Stack, std::uint32_t, StackHash> index_;
    std::vector<const Stack*> stacks_;  ///< keys of the index
};

/// Paint 0 is transparent.
class Palette {
public:
    Palette() { solid({0, 0, 0, 0}); }

    PaintId solid(const Color& premultiplied);
    /// A program of one solid step, or of none, is that colour.
    PaintId add(const PaintProgram& program);

    std::size_t size() const { return paints_.size(); }
    const PaintProgram& operator[](PaintId id) const { return paints_[id]; }
    /// By id.
    std::vector<PaintProgram> take() && { return std::move(paints_); }
    static bool isConstant(const PaintProgram& p) {
        return p.empty() || (p.size() == 1 && p[0].instruction.op == asset::Op::Solid);
    }
    static Color colorOf(const PaintProgram& constant) {
        return constant.empty() ? Color{} : constant[0].color;
    }

    StackTable stacks;  ///< what an EditablePainter's paints are numbers of, instead of programs

private:
    PaintId intern(const PaintProgram& program);

    std::vector<PaintProgram> paints_;
    std::unordered_map<std::string, PaintId> index_;  ///< of programs that are not constant
    NumberMap solids_;                                ///< by a hash of the colour
};

/// One paint; a program, and the colours it uses, are appended to `data`. Throws LimitError if its groups are
/// nested deeper than asset::maxStack, or it has more steps than asset::maxInstructions.
asset::Paint encodePaint(const PaintProgram& program, std::vector<asset::Texel>& data);

/// More paints than this the format cannot name.
inline constexpr std::size_t maxPaints = 0x10000;

/// Writes the palette as the asset's paints, programs to its data. Solid colours beyond the 65536
/// paints that the format can name are merged, each with the nearest of a coarser grid of colours;
/// returns each paint's index and, in `error`, by how much a component may have changed. Throws
/// LimitError if programs alone are too many, and as encodePaint().
std::vector<std::uint16_t> encodePalette(const Palette& palette, asset::Asset& asset, float& error);

}  // namespace vtm::compiler

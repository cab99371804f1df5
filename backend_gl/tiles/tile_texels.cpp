#include "backend_gl/tiles/tile_texels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "backend_gl/tiles/tile_pieces.hpp"

namespace vtm::gl {

namespace {

/// Below, a reference fits half a word.
constexpr std::uint32_t narrowNumbers = 1u << 14;

std::uint32_t countBits(std::size_t count, bool wide) {
    return std::uint32_t(count) << 20 | (wide ? wideBit : 0);
}

std::uint32_t steps(double coordinate) {
    return std::uint32_t(std::lround(std::ldexp(coordinate + 1, tileStepLog2)));
}

/// Fields from the lowest bit of the first word on.
class Packer {
public:
    void add(std::uint32_t value, unsigned bits) {
        const std::uint64_t shifted = std::uint64_t(value & ((1u << bits) - 1)) << (used_ % 32);
        words_[used_ / 32] |= std::uint32_t(shifted);
        if (used_ % 32 + bits > 32)
            words_[used_ / 32 + 1] |= std::uint32_t(shifted >> 32);
        used_ += bits;
    }
    Texel words() const { return words_; }

private:
    Texel words_{};
    unsigned used_ = 0;
};

/// Two words of a texel: 16-bit channels, nothing for programs.
void addColor(Packer& packer, const asset::Paint& paint) {
    for (const std::uint32_t channel : paint)
        packer.add(
            asset::isProgram(paint) ? 0 : std::uint32_t(std::lround(std::bit_cast<float>(channel) * 65535)),
            16);
}

}  // namespace

Texel geometryTexel(const PlanarPiece& piece) {
    Packer packer;
    for (const double v : {piece.a.x, piece.a.y, piece.b.x, piece.b.y})
        packer.add(steps(v), tileCoordinateBits);
    for (const double slope : {piece.slopeA, piece.slopeB})
        packer.add(std::uint32_t(slopeSteps(slope)), 12);
    packer.add(piece.left, 16);
    packer.add(piece.right, 16);
    return packer.words();
}

Texel colorTexel(const asset::Paint& left, const asset::Paint& right) {
    Packer packer;
    addColor(packer, left);
    addColor(packer, right);
    return packer.words();
}

Texel CellWriter::write(const Reference& reference, std::span<const std::uint32_t> list) {
    const bool wide = !list.empty() && list.back() >= narrowNumbers;
    const std::size_t room = wide ? 1 : 2;
    Texel cell = withoutReferences(reference);
    if (list.size() > room) {
        cell[0] |= moreBit;
        cell[3] = append(reference.point, list, wide);
        return cell;
    }
    cell[0] |= countBits(list.size(), wide);
    for (std::size_t i = 0; i < list.size(); ++i)
        cell[3] |= referenceWord(list[i], reference.point) << (i * 16);
    return cell;
}

Texel CellWriter::writeCrowded(const Reference& reference) const {
    Texel cell = withoutReferences(reference);
    cell[0] |= crowdedBit;
    return cell;
}

Texel CellWriter::withoutReferences(const Reference& reference) const {
    Packer packer;
    packer.add(reference.paint, 16);
    packer.add(reference.place, 16);
    addColor(packer, paints_[reference.paint]);
    return packer.words();
}

/// Returns the first texel.
std::uint32_t CellWriter::append(glm::dvec2 point, std::span<const std::uint32_t> list, bool wide) {
    const std::size_t all = wide ? 3 : 6, some = wide ? 2 : 4;
    const auto first = std::uint32_t(texels_.size());
    while (!list.empty()) {
        const bool more = list.size() > all;
        const std::size_t count = more ? some : list.size();
        const auto left = std::uint32_t(std::min<std::size_t>(list.size(), referencesMask));
        Texel texel{countBits(count, wide) | (more ? moreBit : 0) | left, 0, 0, 0};
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t word = referenceWord(list[i], point);
            if (wide)
                texel[1 + i] = word;
            else
                texel[1 + i / 2] |= word << (i % 2 * 16);
        }
        if (more)
            texel[3] = std::uint32_t(texels_.size() + 1);
        texels_.push_back(texel);
        list = list.subspan(count);
    }
    return first;
}

std::uint32_t CellWriter::referenceWord(std::uint32_t number, glm::dvec2 point) const {
    const asset::Sides at = pieces_[number].sidesOf(point);
    return number << 2 | (at.leftOfCurve ? leftOfCurveBit : 0) | (at.leftOfChord ? leftOfChordBit : 0);
}

}  // namespace vtm::gl

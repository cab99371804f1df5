#include "backend_gl/core/turns.hpp"

#include <algorithm>
#include <bit>

namespace vtm::gl {

namespace {

using asset::ImageFilter;
using asset::Op;
using asset::Spread;
using asset::Texel;

/// A loop of n turns, and one more, which a driver may take to find that it is at its end.
constexpr std::uint32_t loop(std::uint32_t turns, std::uint32_t each = 0) { return turns + 1 + turns * each; }

/// stopsUpTo() of gradient.glsl halves [0, count] until nothing is left.
std::uint32_t searchTurns(std::uint32_t count) { return loop(std::uint32_t(std::bit_width(count)) + 1); }

/// Of a period in rampMean(): stretches between stops and the weight's two bends, one before and one behind
/// the stops; three where sums stand for the rest.
std::uint32_t rampTurns(std::uint32_t count) {
    return searchTurns(count) + (count > longRamp ? loop(3, searchTurns(count)) : loop(count + 3));
}

/// colorOver(): a search and a mean, of long ramps two, each over one copy of a padded ramp; of others a mean
/// is over at most twice two periods, and a long one over two.
std::uint32_t gradientTurns(Spread spread, std::uint32_t count) {
    const bool isLong = count > longRamp;
    const std::uint32_t copies = spread == Spread::Pad ? 1 : isLong ? 3 : 5;
    return searchTurns(count) + loop(isLong ? 2 : 1, loop(copies, rampTurns(count)));
}

/// imageColor(): two levels at up to 17 points, each found from the first and read at up to 25 texels.
std::uint32_t imageTurns(const asset::AssetView& asset, const Texel& fill) {
    const auto filter = ImageFilter(fill[3]);
    if (filter < ImageFilter::Trilinear)
        return loop(1, loop(0) + loop(filter == ImageFilter::Nearest ? 1 : 4));
    const image::Bitmap& bitmap = asset.images[fill[2]];
    const auto levels = std::uint32_t(std::bit_width(unsigned(std::max(bitmap.width, bitmap.height))));
    return loop(2 * 17, loop(levels) + loop(25));
}

std::uint32_t layerTurns(const asset::AssetView& asset, const asset::Instruction& in, ImageTurns images) {
    // The words spread and stopCount of a Gradient, image and filter of an ImageFill.
    if (in.op == Op::Linear || in.op == Op::Radial)
        return gradientTurns(Spread(asset.data[in.argument + 1][2]), asset.data[in.argument + 1][3]);
    return in.op == Op::Image && images == ImageTurns::AtMost ? imageTurns(asset, asset.data[in.argument + 1])
                                                              : 0;
}

std::uint32_t turnsOf(const asset::AssetView& asset, const asset::Paint& program, ImageTurns images) {
    std::uint32_t turns = loop(program[1]);
    for (std::uint32_t i = 0; i < program[1]; ++i)
        turns += layerTurns(asset, std::bit_cast<asset::Instruction>(asset.data[program[0] + i]), images);
    return turns;
}

}  // namespace

std::vector<std::uint32_t> programTurns(const asset::AssetView& asset, ImageTurns images) {
    std::vector<std::uint32_t> turns;
    for (const asset::Paint& paint : asset.paints)
        turns.push_back(asset::isProgram(paint) ? turnsOf(asset, paint, images) : 0);
    return turns;
}

}  // namespace vtm::gl

#include "backend_gl/upload/ramp_sums.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "backend_gl/core/turns.hpp"

namespace vtm::gl {

namespace {

using asset::Instruction;
using asset::Op;
using asset::Texel;

/// Calls visit(first texel of the stops, their number) for every gradient with many.
template <class Visit>
void forEachLongRamp(const asset::AssetView& asset, Visit&& visit) {
    constexpr std::size_t head = sizeof(asset::Gradient) / sizeof(Texel);
    for (const asset::Paint& paint : asset.paints)
        for (std::uint32_t i = 0; asset::isProgram(paint) && i < paint[1]; ++i) {
            const auto in = std::bit_cast<Instruction>(asset.data[paint[0] + i]);
            if (in.op != Op::Linear && in.op != Op::Radial)
                continue;
            if (const std::uint32_t count = asset.data[in.argument + 1][3]; count > longRamp)
                visit(in.argument + head, count);
        }
}

using Channels = std::array<double, 4>;

/// Straight, in [0, 1].
Channels colorOf(const Texel& stop) {
    Channels color;
    for (unsigned c = 0; c < 4; ++c)
        color[c] = double(stop[1 + c / 2] >> c % 2 * 16 & 0xFFFF) / 65535;
    return color;
}

/// Of a·c from one stop to the next, both straight lines between stops: Simpson's rule is exact.
Channels integral(const Texel& from, const Texel& to) {
    const double width = double(std::bit_cast<float>(to[0])) - double(std::bit_cast<float>(from[0]));
    const Channels a = colorOf(from), b = colorOf(to);
    Channels sum;
    for (unsigned c = 0; c < 4; ++c) {
        const auto at = [&](double t) {
            const double alpha = a[3] + t * (b[3] - a[3]);
            return c == 3 ? alpha : alpha * (a[c] + t * (b[c] - a[c]));
        };
        sum[c] = width / 6 * (at(0) + 4 * at(0.5) + at(1));
    }
    return sum;
}

std::uint32_t steps(double integral) {
    constexpr double oneStep = 0x1p31;
    return std::uint32_t(std::uint64_t(std::llround(integral * oneStep)));
}

}  // namespace

bool hasLongRamps(const asset::AssetView& asset) {
    bool found = false;
    forEachLongRamp(asset, [&](std::size_t, std::uint32_t) { found = true; });
    return found;
}

std::vector<Texel> rampSums(const asset::AssetView& asset) {
    // Gradients of hostile files may overlap: from where on texels follow each other as stops of one is what
    // matters, and is found once.
    std::vector<std::size_t> ends;
    forEachLongRamp(asset, [&](std::size_t first, std::uint32_t count) {
        ends.resize(asset.data.size());
        ends[first] = std::max(ends[first], first + count);
    });
    std::vector<Texel> sums(ends.size());
    Channels sum{};
    std::size_t end = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (i < end) {
            const Channels more = integral(asset.data[i - 1], asset.data[i]);
            for (unsigned c = 0; c < 4; ++c)
                sums[i][c] = steps(sum[c] += more[c]);
        } else {
            sum = {};
        }
        end = std::max(end, ends[i]);
    }
    return sums;
}

}  // namespace vtm::gl

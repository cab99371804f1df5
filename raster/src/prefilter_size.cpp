#include <cmath>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <vtm/raster/prefilter.hpp>
#include "asset/records.hpp"
#include "asset/walk.hpp"
#include "raster/src/paint.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::ivec2;

/// Footprints of one size, side by side over the picture. They are shifted by a third of one, since
/// footprints whose borders are those of the tree's squares meet fewer squares than others.
class Footprints {
public:
    Footprints(const AssetView& asset, PyramidSize size)
        : counts_(std::size_t(size.width + 1) * (size.height + 1)),
          width_(int(size.width) + 1),
          height_(int(size.height) + 1),
          scale_(size.width / asset.width, size.height / asset.height) {}

    /// A square of a layer. Layers over layers (compat mode) are no finer than the finest of them, so each
    /// is counted for itself.
    void add(std::uint32_t layer, dvec2 corner, double side, bool hasPieces) {
        const ivec2 from = cellOf(corner), to = cellOf(corner + side);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                Count& count = counts_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
                count.ofLayer = count.layer == layer ? count.ofLayer + 1 : 1;
                count.layer = layer;
                count.squares = std::max(count.squares, count.ofLayer);
                count.hasPieces |= hasPieces;
            }
    }

    /// Squares that a footprint meets, averaged over those that meet more than one of a single colour.
    double mean() const {
        double squares = 0, footprints = 0;
        for (const Count& count : counts_)
            if (count.hasPieces || count.squares > 1) {
                squares += count.squares;
                ++footprints;
            }
        return footprints > 0 ? squares / footprints : 0;
    }

private:
    struct Count {
        std::uint32_t squares = 0;             ///< of the layer that has most
        std::uint32_t layer = 0, ofLayer = 0;  ///< the layer that is being counted
        bool hasPieces = false;
    };

    ivec2 cellOf(dvec2 point) const {
        return glm::clamp(ivec2(glm::floor(glm::clamp(point * scale_ + 1.0 / 3, -1.0, 2.0 * maxPyramidSide))),
                          ivec2(0), ivec2(width_ - 1, height_ - 1));
    }

    std::vector<Count> counts_;
    int width_, height_;
    dvec2 scale_;
};

bool drawsMap(Command::Kind kind) {
    return kind == Command::Kind::DrawMap || kind == Command::Kind::FillMask ||
           kind == Command::Kind::ClipMask;
}

double squaresPerFootprint(const AssetView& asset, PyramidSize size) {
    Footprints footprints(asset, size);
    for (std::uint32_t layer = 0; layer < asset.commands.size(); ++layer) {
        if (!drawsMap(asset.commands[layer].kind))
            continue;
        const Map& map = asset.maps[asset.commands[layer].map];
        walk(asset, map.root, [&](Cell cell, Entry entry) {
            const bool isSolid = entry.kind() == Entry::Kind::Solid;
            if (isSolid && asset.paints[entry.payload()] == Paint{})
                return;
            const double side = std::ldexp(map.side, -2 * int(cell.level));
            footprints.add(layer, {map.x + cell.x * side, map.y + cell.y * side}, side, !isSolid);
        });
    }
    return footprints.mean();
}

/// The largest side that is allowed and at most `side`: 2^k or 3·2^k.
std::uint32_t sideAtMost(double side) {
    std::uint32_t best = 1;
    for (std::uint32_t s = 1; s <= maxPyramidSide && s <= side; ++s)
        if (isPyramidSide(s))
            best = s;
    return best;
}

/// The allowed side that is nearest in ratio.
std::uint32_t sideNear(double side) {
    const std::uint32_t below = sideAtMost(side);
    const std::uint32_t above = isPyramidSide(below + below / 2) ? below + below / 2 : below / 3 * 4;
    return above > below && above <= maxPyramidSide && side / below > above / side ? above : below;
}

/// Texels nearly as wide as high, `longer` of them along the longer side.
PyramidSize sizeWith(const AssetView& asset, std::uint32_t longer) {
    if (asset.width >= asset.height)
        return {longer, sideNear(longer * (asset.height / asset.width))};
    return {sideNear(longer * (asset.width / asset.height)), longer};
}

/// Pixels that the finest image fill lays along the picture's longer side; 0 without images. A footprint of
/// two of them is the largest that a bilinear fill can be sampled at without skipping pixels, and an oblong
/// one that a trilinear fill can without blurring its narrow side.
double imagePixels(const AssetView& asset) {
    double finest = 0;
    for (const Paint& paint : asset.paints)
        for (std::uint32_t i = 0; isProgram(paint) && i < paint[1]; ++i) {
            const auto in = recordAt<Instruction>(asset.data, paint[0] + i);
            if (in.op != Op::Image)
                continue;
            const std::array<float, 6> m = recordAt<ImageFill>(asset.data, in.argument).matrix;
            finest = std::max(finest, std::sqrt(std::abs(double(m[0]) * m[3] - double(m[1]) * m[2])));
        }
    return finest * std::max(asset.width, asset.height);
}

}  // namespace

PyramidSize prefilterSize(const AssetView& asset, const PrefilterOptions& options) {
    if (!(options.squaresPerFootprint >= 1) || options.largestSide < 1 ||
        options.largestSide > maxPyramidSide)
        throw std::invalid_argument(
            "prefilter: squaresPerFootprint must be >= 1 and largestSide in [1, 4096]");
    // Footprints grow until they meet too much; a base texel is half as wide as these.
    const double images = imagePixels(asset);
    std::uint32_t side = sideAtMost(options.largestSide);
    while (side > 1 && side > images &&
           squaresPerFootprint(asset, sizeWith(asset, sideAtMost(side / 2.0))) <= options.squaresPerFootprint)
        side = sideAtMost(side - 1);
    return sizeWith(asset, side);
}

}  // namespace vtm::asset

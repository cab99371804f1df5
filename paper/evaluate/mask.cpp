// Masks of the paper mode: the 16-tree, early out, coverage and the mip of the classification function.

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "paper/evaluate.hpp"

namespace vtm::paper {

namespace {

using asset::Entry;
using glm::dvec2;

/// Where a point's walk down the tree ended.
struct Place {
    Entry entry;
    dvec2 inCell;  ///< in [0, 1), without the margin
    double side;   ///< of the cell, as a share of the mask's
};

/// `uv` in [0, 1).
Place find(const Mask& mask, dvec2 uv, Cost& cost) {
    Place place{mask.root, uv, 1};
    while (place.entry.kind() == Entry::Kind::Node) {
        const dvec2 scaled = place.inCell * 4.0, child = glm::min(glm::floor(scaled), dvec2(3));
        place = {mask.nodes[place.entry.payload()].children[std::size_t(4 * child.y + child.x)],
                 scaled - child, place.side / 4};
        ++cost.indirections;
    }
    return place;
}

bool isInUnitSquare(dvec2 uv) { return uv.x >= 0 && uv.y >= 0 && uv.x < 1 && uv.y < 1; }

/// `unitToPixels` maps the mask's unit square.
double cellCoverage(const Mask& mask, dvec2 uv, const glm::dmat2& unitToPixels, Cost& cost) {
    if (!isInUnitSquare(uv))
        return 0;
    const Place place = find(mask, uv, cost);
    if (place.entry.kind() == Entry::Kind::Solid)  // early out, row 9
        return place.entry.payload();
    ++cost.cells;
    const double grown = 1 + 2 * cellMargin;
    const double h = signedDistance(mask.cells[place.entry.payload()], (place.inCell + cellMargin) / grown,
                                    unitToPixels * (place.side * grown));
    return std::clamp(0.5 - h, 0.0, 1.0);
}

// ---- The mip ------------------------------------------------------------------------------------

/// Level k of n + 1 has 2^(n-k) texels a side.
std::size_t levelStart(unsigned sizeLog2, unsigned level) {
    std::size_t start = 0;
    for (unsigned k = 0; k < level; ++k)
        start += std::size_t(1) << (2 * (sizeLog2 - k));
    return start;
}

/// Bilinear between texel centres, zero beyond the border.
double storedLevel(const Mip& mip, unsigned level, dvec2 uv) {
    const int size = 1 << (mip.sizeLog2 - level);
    const dvec2 p = glm::clamp(uv * double(size) - 0.5, dvec2(-2), dvec2(size + 1)), corner = glm::floor(p);
    const std::size_t start = levelStart(mip.sizeLog2, level);
    double sum = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int x = int(corner.x) + i, y = int(corner.y) + j;
            if (x < 0 || y < 0 || x >= size || y >= size)
                continue;
            const dvec2 weight = 1.0 - glm::abs(p - dvec2(x, y));
            sum += weight.x * weight.y * mip.texels[start + std::size_t(y * size + x)];
        }
    return sum / 255;
}

/// Level 0 is half a step finer than what is stored: the analytic coverage stands for it. Beyond the
/// last level a mask is one texel in the middle of ever larger, ever fainter ones.
double level(const Mip& mip, unsigned k, dvec2 uv, Cost& cost) {
    ++cost.mips;
    if (k - 1 <= mip.sizeLog2)
        return storedLevel(mip, k - 1, uv);
    const double shrink = std::ldexp(1.0, -int(k - 1 - mip.sizeLog2));
    const dvec2 weight = glm::max(dvec2(0), 1.0 - glm::abs(uv - 0.5) * shrink);
    return weight.x * weight.y * shrink * shrink * mip.texels.back() / 255;
}

/// The pixel's longer axis in texels of level 0, as a power of two.
double levelOfDetail(const Mask& mask, double longer) {
    return std::min(std::log2(longer) + mask.mip.sizeLog2 + 1, maxLod);
}

/// A level's bilinear filter reaches less than two pixels beyond the square.
bool isFar(dvec2 uv, double longer) {
    const double reach = 0.5 + 2 * longer;
    return std::abs(uv.x - 0.5) >= reach || std::abs(uv.y - 0.5) >= reach;
}

}  // namespace

Footprint::Footprint(const glm::dmat2& linear) : toPixels(linear) {
    const glm::dmat2 toPicture = glm::inverse(linear);
    longer = std::max(glm::length(toPicture[0]), glm::length(toPicture[1]));
}

double maskCoverage(const Mask& mask, dvec2 point, const Footprint& pixel, Cost& cost) {
    ++cost.masks;
    const dvec2 uv = (point - dvec2(mask.x, mask.y)) / mask.side;
    const double longer = pixel.longer / mask.side;
    if (isFar(uv, longer))
        return 0;
    const glm::dmat2 unitToPixels = pixel.toPixels * mask.side;
    const double lod = levelOfDetail(mask, longer);
    if (lod <= 0)
        return cellCoverage(mask, uv, unitToPixels, cost);
    const double base = std::floor(lod), blend = lod - base;
    const double finer =
        base == 0 ? cellCoverage(mask, uv, unitToPixels, cost) : level(mask.mip, unsigned(base), uv, cost);
    return glm::mix(finer, level(mask.mip, unsigned(base) + 1, uv, cost), blend);
}

double repeatedCoverage(const Mask& mask, dvec2 pictureSize, dvec2 point, const Footprint& pixel,
                        Cost& cost) {
    const dvec2 share = mask.side / pictureSize;
    const double mean = share.x * share.y * mask.mip.texels.back() / 255,
                 periods = pixel.longer / std::min(pictureSize.x, pictureSize.y);
    return glm::mix(maskCoverage(mask, point, pixel, cost), mean,
                    std::clamp(std::log2(periods) + 1, 0.0, 1.0));
}

bool classify(const Mask& mask, dvec2 point) {
    const dvec2 uv = (point - dvec2(mask.x, mask.y)) / mask.side;
    Cost unused;
    if (!isInUnitSquare(uv))
        return false;
    const Place place = find(mask, uv, unused);
    if (place.entry.kind() == Entry::Kind::Solid)
        return place.entry.payload() != 0;
    return signedDistance(mask.cells[place.entry.payload()],
                          (place.inCell + cellMargin) / (1 + 2 * cellMargin), glm::dmat2(1)) < 0;
}

}  // namespace vtm::paper

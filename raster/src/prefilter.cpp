#include <vtm/raster/prefilter.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "asset/instances.hpp"
#include "asset/records.hpp"
#include "asset/walk.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::ivec2;

/// What drawing a footprint from the tree takes.
struct Work {
    double squares = 0;
    double time = 0;  ///< in squares of one colour
};

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
    /// is counted for itself. `time`: what it takes, in squares of one colour.
    void add(std::uint32_t layer, dvec2 corner, dvec2 size, double time, bool hasPieces) {
        const ivec2 from = cellOf(corner), to = cellOf(corner + size);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                Count& count = counts_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
                if (count.layer != layer)
                    count.ofLayer = {};
                count.layer = layer;
                ++count.ofLayer.squares;
                count.ofLayer.time += time;
                count.most.squares = std::max(count.most.squares, count.ofLayer.squares);
                count.most.time = std::max(count.most.time, count.ofLayer.time);
                count.hasPieces |= hasPieces;
            }
    }

    /// What a footprint meets, averaged over those that meet more than one square of a single colour.
    Work mean() const {
        Work sum;
        double footprints = 0;
        for (const Count& count : counts_)
            if (count.hasPieces || count.most.squares > 1) {
                sum.squares += count.most.squares;
                sum.time += count.most.time;
                ++footprints;
            }
        return footprints > 0 ? Work{sum.squares / footprints, sum.time / footprints} : Work{};
    }

private:
    struct Count {
        Work most;                ///< of the layer that has most
        std::uint32_t layer = 0;  ///< the layer that is being counted
        Work ofLayer;
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

/// What a square takes of a sampler's time, in squares of one colour; measured (docs/prefilter.md).
double timeOf(const AssetView& asset, const PlacedMap& placed, Entry entry) {
    constexpr double piece = 0.4, program = 4;
    const auto paintTime = [&](std::uint32_t number) {
        return isProgram(asset.paints[placed.paints(number)]) ? program : 0;
    };
    if (entry.kind() == Entry::Kind::Solid)
        return 1 + paintTime(entry.payload());
    const Leaf& leaf = asset.leaves[entry.payload()];
    double paints = 0;
    for (const std::uint16_t corner : leaf.corners)
        paints = std::max(paints, paintTime(corner));
    return 1 + piece * leaf.pieceCount + paints;
}

/// Boxes around them, where the map is turned.
void addSquares(const AssetView& asset, const PlacedMap& placed, std::uint32_t layer,
                Footprints& footprints) {
    const glm::dmat2& linear = placed.toPicture.linear;
    const dvec2 size = glm::abs(linear[0]) + glm::abs(linear[1]);
    walk(asset, placed.map.root, [&](Cell cell, Entry entry) {
        const bool isSolid = entry.kind() == Entry::Kind::Solid;
        if (isSolid && (entry.payload() == 0 || asset.paints[placed.paints(entry.payload())] == Paint{}))
            return;
        const double side = std::ldexp(1.0, -2 * int(cell.level));
        const dvec2 centre = placed.toPicture((dvec2(cell.x, cell.y) + 0.5) * side);
        footprints.add(layer, centre - 0.5 * side * size, side * size, timeOf(asset, placed, entry),
                       !isSolid);
    });
}

Work workPerFootprint(const AssetView& asset, PyramidSize size) {
    Footprints footprints(asset, size);
    for (std::uint32_t layer = 0; layer < asset.commands.size(); ++layer) {
        if (!drawsMap(asset.commands[layer].kind))
            continue;
        forEachMap(asset, asset.maps[asset.commands[layer].map], [&](const PlacedMap& placed) {
            addSquares(asset, placed, layer, footprints);
            return true;
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

// ---- Means ----------------------------------------------------------------------------------------

/// Means before they are rounded: four doubles a texel.
struct Means {
    PyramidSize size;
    std::vector<double> values;

    double* at(std::uint32_t x, std::uint32_t y) { return &values[(std::size_t(y) * size.width + x) * 4]; }
    const double* at(std::uint32_t x, std::uint32_t y) const {
        return &values[(std::size_t(y) * size.width + x) * 4];
    }
};

/// Rows that are evaluated in one go. The number is part of the result's last bits, so it does not depend on
/// the number of threads.
constexpr std::uint32_t bandRows = 64;

/// Evaluation points a texel and axis where a paint varies within a texel.
constexpr std::uint32_t finerGrid = 4;

/// mean += each `grid` × `grid` pixels of a raster whose first row is the first pixel row of texel row `row`.
void addMeans(const image::Raster& raster, std::uint32_t grid, std::uint32_t row, Means& means) {
    const double share = 1.0 / (double(grid) * grid);
    for (std::uint32_t y = 0; y < std::uint32_t(raster.height); ++y)
        for (std::uint32_t x = 0; x < std::uint32_t(raster.width); ++x) {
            const float* pixel = raster.pixel(int(x), int(y));
            double* mean = means.at(x / grid, row + y / grid);
            for (int c = 0; c < 4; ++c)
                mean[c] += share * double(pixel[c]);
        }
}

/// Rows `row` on, so many.
View viewOfRows(const AssetView& asset, PyramidSize size, std::uint32_t grid, std::uint32_t row,
                std::uint32_t rows) {
    const double x = size.width * grid / asset.width, y = size.height * grid / asset.height;
    return {int(size.width * grid), int(rows * grid), glm::dmat3x2(x, 0, 0, y, 0, -double(row) * grid)};
}

/// Runs work(i) for all i below `count`, on up to `threads` threads; rethrows what one of them threw.
template <class Work>
void inParallel(std::uint32_t count, unsigned threads, Work&& work) {
    std::atomic<std::uint32_t> next = 0;
    std::exception_ptr failure;
    std::mutex failureLock;
    const auto run = [&, holding = limits::current()] {
        const limits::Scope scope(holding);
        try {
            for (std::uint32_t i = next++; i < count; i = next++)
                work(i);
        } catch (...) {
            const std::scoped_lock lock(failureLock);
            failure = std::current_exception();
        }
    };
    if (threads == 0)
        threads = std::max(1u, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> others;
        for (unsigned i = 1; i < std::min(threads, count); ++i)
            others.emplace_back(run);
        run();
    }
    if (failure)
        std::rethrow_exception(failure);
}

template <class Engine>
Means meansBy(const Engine& engine, const AssetView& asset, PyramidSize size, std::uint32_t grid,
              unsigned threads) {
    const std::uint32_t band = bandRows / grid;
    Means means{size, std::vector<double>(size.texels() * 4)};
    inParallel((size.height + band - 1) / band, threads, [&](std::uint32_t i) {
        const std::uint32_t row = i * band, rows = std::min(band, size.height - row);
        addMeans(engine.draw(viewOfRows(asset, size, grid, row, rows)), grid, row, means);
    });
    return means;
}

/// Programs take the evaluator twenty times as long as the scanner, which on the finer grid is as good.
Means baseMeans(const AssetView& asset, PyramidSize size, unsigned threads) {
    if (std::ranges::none_of(asset.paints, isProgram))
        return meansBy(Evaluator(asset), asset, size, 1, threads);
    if (isSumOfMaps(asset))
        return meansBy(Scanner(asset), asset, size, finerGrid, threads);
    return meansBy(Evaluator(asset), asset, size, finerGrid, threads);
}

/// The next level: whole texels of the finer one make one of the coarser.
Means coarser(const Means& fine) {
    const PyramidSize size = fine.size.level(1);
    const std::uint32_t columns = fine.size.width / size.width, rows = fine.size.height / size.height;
    const double share = 1.0 / (double(columns) * rows);
    Means means{size, std::vector<double>(size.texels() * 4)};
    for (std::uint32_t y = 0; y < fine.size.height; ++y)
        for (std::uint32_t x = 0; x < fine.size.width; ++x)
            for (int c = 0; c < 4; ++c)
                means.at(x / columns, y / rows)[c] += share * fine.at(x, y)[c];
    return means;
}

// ---- How fine -------------------------------------------------------------------------------------

/// The finest base that saves time, and that so many bytes of the tree's allow; 0: none. A picture of 128
/// pixels is drawn from the tree whatever that takes.
std::uint32_t fastestSide(const AssetView& asset, const PrefilterOptions& options) {
    constexpr std::uint32_t finest = 384;
    /// In squares of one colour: about twice the filter's time.
    constexpr double worthwhile = 4.5;
    const double most = options.timesTree * double(summarize(asset).bytes) / sizeof(Rgba8);
    const auto pays = [&](std::uint32_t side) {
        const PyramidSize size = sizeWith(asset, side);
        return double(size.texelsBefore(size.levels())) <= most &&
               workPerFootprint(asset, sizeWith(asset, sideAtMost(side / 2.0))).time > worthwhile;
    };
    std::uint32_t side = sideAtMost(std::min(options.largestSide, finest));
    while (side > 0 && !pays(side))
        side = side > 1 ? sideAtMost(side - 1) : 0;
    return side;
}

}  // namespace

PyramidSize prefilterSize(const AssetView& asset, const PrefilterOptions& options) {
    if (!(options.squaresPerFootprint >= 1) || !(options.timesTree >= 0) || options.largestSide < 1 ||
        options.largestSide > maxPyramidSide)
        throw std::invalid_argument(
            "prefilter: squaresPerFootprint must be >= 1, timesTree >= 0 and largestSide in [1, 4096]");
    // Footprints grow until they meet too much; a base texel is half as wide as these.
    const double images = imagePixels(asset);
    std::uint32_t side = sideAtMost(options.largestSide);
    while (side > 1 && side > images &&
           workPerFootprint(asset, sizeWith(asset, sideAtMost(side / 2.0))).squares <=
               options.squaresPerFootprint)
        side = sideAtMost(side - 1);
    // An image is itself down to its own pixels, which means would blur; how fine a material is we do not
    // know.
    if (images > 0 || !asset.materials.empty())
        return sizeWith(asset, side);
    const std::uint32_t fastest = fastestSide(asset, options);
    return sizeWith(asset, std::max(side, fastest));
}

namespace {

/// NaN becomes 0.
std::uint8_t rounded(double mean) {
    return std::uint8_t(std::lround(mean > 0 ? std::min(mean, 1.0) * 255 : 0));
}

/// Every level from unrounded means of the level before, so no rounding is carried on.
template <class Take>
void eachMean(Means means, Take&& take) {
    const unsigned levels = means.size.levels();
    for (unsigned l = 0; l < levels; ++l) {
        for (std::size_t i = 0; i < means.values.size(); i += 4)
            take(&means.values[i]);
        if (l + 1 < levels)
            means = coarser(means);
    }
}

void requireAllowed(PyramidSize size) {
    if (!isPyramidSide(size.width) || !isPyramidSide(size.height))
        throw std::invalid_argument("prefilter: sides must be 2^k or 3 * 2^k texels, at most 4096");
}

}  // namespace

Prefilter buildPrefilter(const AssetView& asset, PyramidSize size, unsigned threads) {
    requireAllowed(size);
    Prefilter prefilter{size, {}};
    eachMean(baseMeans(asset, size, threads), [&](const double* mean) {
        prefilter.texels.push_back({rounded(mean[0]), rounded(mean[1]), rounded(mean[2]), rounded(mean[3])});
    });
    return prefilter;
}

Prefilter buildPrefilter(const AssetView& asset, const PrefilterOptions& options) {
    return buildPrefilter(asset, prefilterSize(asset, options), options.threads);
}

}  // namespace vtm::asset

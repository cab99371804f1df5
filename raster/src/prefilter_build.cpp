#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/prefilter.hpp>
#include "raster/src/paint.hpp"

namespace vtm::asset {

namespace {

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

image::Raster evaluateRows(const Paints& paints, PyramidSize size, std::uint32_t grid, std::uint32_t row,
                           std::uint32_t rows) {
    const double x = size.width * grid / paints.asset().width, y = size.height * grid / paints.asset().height;
    return evaluate(
        paints, {int(size.width * grid), int(rows * grid), glm::dmat3x2(x, 0, 0, y, 0, -double(row) * grid)});
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

Means baseMeans(const AssetView& asset, PyramidSize size, unsigned threads) {
    const std::uint32_t grid = std::ranges::any_of(asset.paints, isProgram) ? finerGrid : 1;
    const std::uint32_t band = bandRows / grid;
    Means means{size, std::vector<double>(size.texels() * 4)};
    const Paints paints(asset);
    inParallel((size.height + band - 1) / band, threads, [&](std::uint32_t i) {
        const std::uint32_t row = i * band, rows = std::min(band, size.height - row);
        addMeans(evaluateRows(paints, size, grid, row, rows), grid, row, means);
    });
    return means;
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

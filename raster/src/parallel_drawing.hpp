/// \file
/// Drawing one view on all processors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vtm/limits/limits.hpp>
#include "raster/drawing_threads.hpp"
#include "raster/src/drawing.hpp"

namespace vtm::asset {

/// RowScratches that nobody uses.
class ScratchPool {
public:
    std::unique_ptr<RowScratch> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty())
            return std::make_unique<RowScratch>();
        std::unique_ptr<RowScratch> scratch = std::move(free_.back());
        free_.pop_back();
        return scratch;
    }
    void giveBack(std::unique_ptr<RowScratch> scratch) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(scratch));
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<RowScratch>> free_;
};

/// Draws one view on all processors. Each makes the chords of some of the picture's parts; then each draws
/// some bands, of chords in the order of the parts, so that the sums do not depend on who made which.
class ParallelDrawing {
public:
    ParallelDrawing(const Scanned& of, const View& view, ScratchPool& pool)
        : of_(of), view_(view), pool_(pool), finerLevels_(finerLevelsOf(of, view)) {}

    /// Whether it is worth it. In a small picture levels of detail leave little of many boundaries.
    static bool pays(const Scanned& of, const View& view) {
        constexpr std::size_t somePixels = 1u << 14, boundary = 300;
        const std::size_t pixels = pixelsIn(view);
        return pixels >= somePixels &&
               areThreadsWorthIt(pixels, of.hasPrograms(), boundary * std::min(of.boundaryCount(), pixels));
    }

    /// `store`: called by several threads at once.
    template <class Store>
    void draw(const Store& store) {
        const limits::Stage stage("scanning");
        const auto threads = std::size_t(tbb::this_task_arena::max_concurrency());
        makeChords(threads);
        const int bands = (view_.height + bandRows - 1) / bandRows;
        const int tasks = std::min(bands, int(4 * threads));
        tbb::parallel_for(0, tasks, [&, holding = limits::current()](int task) {
            const limits::Scope scope(holding);
            drawBands(bands * task / tasks, bands * (task + 1) / tasks, store);
        });
        // An exception loses the scratches, whose sums may be half done.
        for (std::unique_ptr<RowScratch>& scratch : made_)
            pool_.giveBack(std::move(scratch));
    }

private:
    void makeChords(std::size_t count) {
        const std::vector<std::size_t> costs = of_.costsBefore();
        const auto firstPart = [&](std::size_t i) {
            const std::size_t cost = costs.back() * i / count;
            return std::size_t(std::ranges::lower_bound(costs, cost) - costs.begin());
        };
        made_.resize(count);
        tbb::parallel_for(std::size_t{0}, made_.size(), [&, holding = limits::current()](std::size_t i) {
            const limits::Scope scope(holding);
            made_[i] = pool_.take();
            Drawing drawing(of_, view_, noMaterials_, *made_[i], finerLevels_);
            drawing.addParts(firstPart(i), firstPart(i + 1));
        });
    }

    template <class Store>
    void drawBands(int first, int end, const Store& store) {
        std::unique_ptr<RowScratch> scratch = pool_.take();
        Drawing drawing(of_, view_, noMaterials_, *scratch, finerLevels_);
        std::vector<std::span<const Chord>> parts(made_.size());
        for (int band = first; band < end; ++band) {
            for (std::size_t i = 0; i < parts.size(); ++i)
                parts[i] = made_[i]->bands.of(band);
            drawing.draw(band, parts, store);
        }
        pool_.giveBack(std::move(scratch));
    }

    const Scanned& of_;
    const View& view_;
    ScratchPool& pool_;
    const MaterialFunction noMaterials_;
    const int finerLevels_;
    std::vector<std::unique_ptr<RowScratch>> made_;  ///< chords of the parts, in their order
};

}  // namespace vtm::asset

/// \file
/// A picture under a view that keeps and visits only the pixels round what has been drawn on it.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include <vtm/raster/pixel_box.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "raster/src/float4.hpp"
#include "raster/src/pixel_memory.hpp"
#include "raster/src/row_parts.hpp"

namespace vtm::asset {

/// Pixels first to end - 1 of a row of a raster.
struct PixelRun {
    int first = 0, end = 0;

    bool empty() const { return first >= end; }
    PixelRun intersection(const PixelRun& other) const {
        return {std::max(first, other.first), std::min(end, other.end)};
    }
};

/// Premultiplied sRGB-encoded pixels: of each row one run; all others are transparent.
class Canvas {
public:
    explicit Canvas(const View& of) : view_(of) {}
    /// `pixels`: of the box, row by row.
    Canvas(const View& of, const PixelBox& box, PixelMemory pixels)
        : view_(of),
          box_(box),
          runs_(std::size_t(box.height()), PixelRun{box.min.x, box.max.x}),
          pixels_(std::move(pixels)) {}

    const View& view() const { return view_; }
    PixelBox whole() const { return {{0, 0}, {view_.width, view_.height}}; }
    /// Round all runs.
    PixelBox bounds() const;

    /// Nothing was drawn.
    bool empty() const { return box_.empty(); }
    /// Makes room for a box, which must lie in the raster.
    void reserve(const PixelBox& box);
    /// Makes `run` part of the run of row y, both in what was reserved; its first pixel.
    Float4* extend(int y, const PixelRun& run) {
        PixelRun& drawn = runs_[std::size_t(y - box_.min.y)];
        if (drawn.empty()) {
            drawn = run;
            std::fill(at(y, run.first), at(y, run.end), Float4{});
        } else {
            if (run.first < drawn.first)
                std::fill(at(y, run.first), at(y, std::exchange(drawn.first, run.first)), Float4{});
            if (run.end > drawn.end)
                std::fill(at(y, std::exchange(drawn.end, run.end)), at(y, run.end), Float4{});
        }
        return at(y, run.first);
    }

    /// Makes `run` that of row y, in what was reserved; its first pixel. None of them has a value yet.
    Float4* beginRun(int y, const PixelRun& run) {
        runs_[std::size_t(y - box_.min.y)] = run;
        return at(y, run.first);
    }

    /// Of a row of the raster.
    PixelRun run(int y) const {
        return y >= box_.min.y && y < box_.max.y ? runs_[std::size_t(y - box_.min.y)] : PixelRun{};
    }
    /// A pixel of a run, and those after it.
    Float4* at(int y, int x) { return pixels_.data() + offset(y, x); }
    const Float4* at(int y, int x) const { return pixels_.data() + offset(y, x); }

    /// Calls change(run) for each row, which keeps of its run what that returns.
    template <class Change>
    void restrict(Change change) {
        for (int y = box_.min.y; y < box_.max.y; ++y)
            runs_[std::size_t(y - box_.min.y)] = change(y, run(y));
    }

    /// Its memory, a box row by row that holds all that was drawn; transparent elsewhere. Nothing is left.
    std::pair<PixelBox, PixelMemory> takeBox();
    /// The whole raster, each channel in [0, 1].
    image::Raster toRaster() const;
    /// The same, rounded to nearest.
    void toBytes(const ByteTarget& target) const;
    /// Of rows first to end - 1 the same, four floats a pixel.
    void giveRows(int first, int end, const std::function<void(std::span<const float> row)>& take) const;

private:
    std::size_t offset(int y, int x) const {
        return std::size_t(y - box_.min.y) * std::size_t(box_.width()) + std::size_t(x - box_.min.x);
    }

    View view_;
    PixelBox box_;  ///< of the memory
    std::vector<PixelRun> runs_;
    PixelMemory pixels_;
};

/// Calls change(pixel of `to`, of `from`) where `from` has pixels.
template <class Change>
void combine(const Canvas& from, Canvas& to, Change change) {
    const PixelBox box = from.bounds();
    to.reserve(box);
    eachRow(box, [&](int y) {
        const PixelRun run = from.run(y);
        if (run.empty())
            return;
        const Float4* source = from.at(y, run.first);
        Float4* target = to.extend(y, run);
        for (int x = 0; x < run.end - run.first; ++x)
            target[x] = change(target[x], source[x]);
    });
}

}  // namespace vtm::asset

/// \file
/// Pixels of a band that are no sums: runs of which one paint program has all.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "raster/chord.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// A pixel of a band.
struct BandPixel {
    int row, x;

    auto operator<=>(const BandPixel&) const = default;
};

class ProgramPixels {
public:
    bool empty() const { return isEmpty_; }
    /// The program has all of the pixels first to end - 1.
    void addAlone(int row, int first, int end, std::uint32_t paint) {
        alone_[std::size_t(row)].push_back({first, end, paint});
        isEmpty_ = false;
    }
    void clear() {
        if (isEmpty_)
            return;
        for (std::vector<Alone>& row : alone_)
            row.clear();
        isEmpty_ = true;
    }

    void beginRow(int row) {
        row_ = row;
        std::ranges::sort(alone(), {}, &Alone::first);
        nextAlone_ = 0;
        done_ = 0;
        findNext();
    }
    /// Takes what the row's sums are, runs of one colour from the left, and stores the row:
    /// drawAlone(first, end, paint) what a program has alone.
    template <class Store, class DrawAlone>
    void finish(int y, int first, int end, Float4 color, Store& store, DrawAlone&& drawAlone) {
        for (int x = std::max(first, done_); x < end;) {
            if (x < nextColumn_) {
                const int to = std::min(end, nextColumn_);
                store(y, x, to, color);
                x = to;
                continue;
            }
            const Alone& run = alone()[nextAlone_];
            done_ = run.end;
            drawAlone(x, done_, run.paint);
            x = done_;
            findNext();
        }
    }

private:
    struct Alone {
        int first, end;
        std::uint32_t paint;
    };
    static constexpr int none = std::numeric_limits<int>::max();

    std::vector<Alone>& alone() { return alone_[std::size_t(row_)]; }
    void findNext() {
        while (nextAlone_ < alone().size() && alone()[nextAlone_].end <= done_)
            ++nextAlone_;
        nextColumn_ = nextAlone_ < alone().size() ? alone()[nextAlone_].first : none;
    }

    std::array<std::vector<Alone>, bandRows> alone_;
    bool isEmpty_ = true;
    // Of the row that is stored.
    int row_ = 0, done_ = 0, nextColumn_ = 0;
    std::size_t nextAlone_ = 0;
};

}  // namespace vtm::asset

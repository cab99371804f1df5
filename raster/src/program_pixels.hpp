/// \file
/// The pixels of a band that paint programs have a share in; all others are runs of one colour.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/src/row_sums.hpp"

namespace vtm::asset {

inline bool isNothing(Float4 color) { return largest(color) < minShare; }
inline bool isNothing(float share) { return std::abs(share) < minShare; }

/// What programs have in a band. Pixels are in blocks; all of those that no program touches are zero.
class ProgramPixels {
public:
    static constexpr int blockWidth = 64;

    void resize(int width) {
        width_ = width;
        blocks_ = (width + blockWidth - 1) / blockWidth;
        pixels_.resize(std::size_t(bandRows) * std::size_t(width), Float4{});
        used_.resize(std::size_t(bandRows) * std::size_t(blocks_), 0);
    }

    /// The pixels first to end - 1, which are to be added to.
    Float4* use(int row, int first, int end) {
        std::fill(used_.begin() + row * blocks_ + first / blockWidth,
                  used_.begin() + row * blocks_ + (end - 1) / blockWidth + 1, 1);
        return at(row, first);
    }

    /// The pixel, which is used, becomes `color` instead of a sum. Rows in order, from the left in each.
    void replace(int row, int x, Float4 color) { replaced_.push_back({row, x, color}); }

    /// Stores a row, to which runs of colours come from the left, and leaves zeros. `top`: the band's.
    template <class Store>
    void finish(int top, int row, int first, int end, Float4 color, Store& store) {
        while (first < end) {
            const int block = first / blockWidth;
            int to = std::min((block + 1) * blockWidth, width_);
            if (!isUsed(row, block)) {
                for (int next = block + 1; to < end && !isUsed(row, next); ++next)
                    to = std::min(to + blockWidth, width_);
                to = std::min(to, end);
                store(top + row, first, to, color);
            } else {
                const int blockEnd = to;
                to = std::min(to, end);
                if (!isNothing(color))
                    for (Float4 *pixel = at(row, first), *last = at(row, to); pixel != last; ++pixel)
                        *pixel += color;
                if (to == blockEnd) {
                    const int start = block * blockWidth;
                    const std::span<Float4> pixels(at(row, start), std::size_t(to - start));
                    putReplaced(row, start, pixels);
                    store(top + row, start, pixels);
                    std::ranges::fill(pixels, Float4{});
                    used_[std::size_t(row * blocks_ + block)] = 0;
                }
            }
            first = to;
        }
    }

private:
    struct Replaced {
        int row, x;
        Float4 color;
    };

    void putReplaced(int row, int start, std::span<Float4> pixels) {
        for (; next_ < replaced_.size() && replaced_[next_].row == row &&
               replaced_[next_].x < start + int(pixels.size());
             ++next_)
            pixels[std::size_t(replaced_[next_].x - start)] = replaced_[next_].color;
        if (next_ == replaced_.size()) {
            replaced_.clear();
            next_ = 0;
        }
    }

    Float4* at(int row, int x) { return pixels_.data() + std::ptrdiff_t(row) * width_ + x; }
    bool isUsed(int row, int block) const { return used_[std::size_t(row * blocks_ + block)] != 0; }

    int width_ = 0, blocks_ = 0;
    std::vector<Float4> pixels_;
    std::vector<std::uint8_t> used_;
    std::vector<Replaced> replaced_;
    std::size_t next_ = 0;  ///< of `replaced_`
};

}  // namespace vtm::asset

#include "image/levels.hpp"
#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <bit>

namespace vtm::image {

namespace {

/// Sums of whole blocks, four 64-bit integers a texel: of colour times alpha, and of alpha times 255. At most
/// 2^26 pixels of 255² each fit well.
using Sums = std::vector<std::uint64_t>;

/// One pass over the picture: a row of sums of every level, each added to the next one when it is complete.
class Pyramid {
public:
    explicit Pyramid(const Bitmap& bitmap) : width_(bitmap.width), height_(bitmap.height) {
        for (int w = width_, h = height_; w > 1 || h > 1;) {
            w = (w + 1) / 2;
            h = (h + 1) / 2;
            levels_.push_back({w, h, {}});
            levels_.back().rgba.reserve(std::size_t(w) * std::size_t(h) * 4);
            rows_.push_back({Sums(std::size_t(w) * 4), 0});
        }
    }

    /// The sums of the next row of level `level` - 1, which stand for `height` rows of pixels.
    void add(std::size_t level, const Sums& finer, int height) {
        if (level > levels_.size())
            return;
        Row& row = rows_[level - 1];
        for (std::size_t i = 0; i < finer.size(); ++i)
            row.sums[i / 8 * 4 + i % 4] += finer[i];
        row.height += height;
        done_ += level == 1 ? 1 : 0;
        if (row.height < 1 << level && done_ < height_)
            return;
        store(level, row);
        add(level + 1, row.sums, row.height);
        std::ranges::fill(row.sums, 0);
        row.height = 0;
    }

    std::vector<Level> take() { return std::move(levels_); }

private:
    struct Row {
        Sums sums;
        int height;  ///< rows of pixels in it
    };

    void store(std::size_t level, const Row& row) {
        std::vector<std::uint8_t>& rgba = levels_[level - 1].rgba;
        for (std::size_t i = 0; i < row.sums.size(); ++i) {
            const int left = int(i / 4) << level, right = std::min(left + (1 << level), width_);
            const std::uint64_t whole = std::uint64_t(right - left) * std::uint64_t(row.height) * 255;
            rgba.push_back(std::uint8_t((2 * row.sums[i] + whole) / (2 * whole)));
        }
    }

    int width_, height_, done_ = 0;
    std::vector<Level> levels_;
    std::vector<Row> rows_;
};

}  // namespace

std::vector<Level> levelsOf(const Bitmap& bitmap) {
    Pyramid pyramid(bitmap);
    Sums row(std::size_t(bitmap.width) * 4);
    for (std::size_t at = 0; at < bitmap.rgba.size(); at += row.size()) {
        limits::check();
        for (std::size_t i = 0; i < row.size(); i += 4) {
            const std::uint8_t* p = &bitmap.rgba[at + i];
            for (std::size_t c = 0; c < 3; ++c)
                row[i + c] = std::uint64_t(p[c]) * p[3];
            row[i + 3] = std::uint64_t(p[3]) * 255;
        }
        pyramid.add(1, row, 1);
    }
    return pyramid.take();
}

unsigned levelCount(const Bitmap& bitmap) {
    return unsigned(std::bit_width(unsigned(std::max(bitmap.width, bitmap.height)) - 1));
}

}  // namespace vtm::image

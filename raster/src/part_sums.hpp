/// \file
/// What a program has of pixels, with the first moments of its part: a colour that changes evenly over a
/// pixel has its mean over a part of it in the part's centroid (docs/coverage.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/vec2.hpp>

#include "raster/chord.hpp"
#include "raster/src/float4.hpp"
#include "raster/src/row_sums.hpp"

namespace vtm::asset {

/// A part of a pixel: its area, and the first moments of that about the pixel's middle.
struct PartOfPixel {
    float share;
    glm::vec2 moment;

    explicit PartOfPixel(Float4 sum) : share(sum[0]), moment(sum[1], sum[2]) {}
    float squaredMoment() const { return moment.x * moment.x + moment.y * moment.y; }
};

/// Parts of a band's pixels, as running sums of what begins at chords.
class PartSums {
public:
    void resize(int width) {
        width_ = width;
        sums_.resize(width);
    }

    /// As Accumulator::add.
    void add(const Chord& chord, float top, int rows, float change) {
        glm::vec2 a = chord.a, b = chord.b;
        a.y -= top;
        b.y -= top;
        if (a.y > b.y)
            std::swap(a, b);
        else
            change = -change;
        const int row = truncated(a.y), column = truncated(a.x);
        if (row == truncated(b.y) && column == truncated(b.x) && a.y >= 0 && row >= 0 && row < rows &&
            std::min(a.x, b.x) >= 0 && column >= 0 && column < width_) {
            const glm::vec2 up(0, float(row) + 0.5f);
            return addInPixel(std::size_t(row), column, a - up, b - up, change);
        }
        const float end = std::min(b.y, float(rows));
        if (!(std::max(a.y, 0.0f) < end))
            return;
        const float slope = (b.x - a.x) / (b.y - a.y);
        glm::vec2 from = a;
        if (from.y < 0)
            from = {a.x - a.y * slope, 0};
        for (auto y = std::size_t(from.y); from.y < end; ++y) {
            glm::vec2 to{b.x, float(y + 1)};
            if (to.y < b.y)
                to.x = a.x + (to.y - a.y) * slope;
            else
                to.y = b.y;
            addInRow(y, from, to, change);
            from = to;
        }
    }

    /// As Accumulator::resolve, of Float4 that PartOfPixel reads.
    template <class Run>
    void resolve(std::size_t row, int first, int end, Run&& run) {
        sums_.resolve(row, first, end, run);
    }

private:
    /// Of a line downwards in a row.
    void addInRow(std::size_t row, glm::vec2 from, glm::vec2 to, float change) {
        const auto right = float(width_);
        const float middle = float(row) + 0.5f;
        from.y -= middle;
        to.y -= middle;
        const bool isRising = to.x < from.x;  // seen from left to right
        glm::vec2 left = isRising ? to : from, last = isRising ? from : to;
        if (left.x >= right)
            return;
        if (last.x <= 0)
            return addWhole(row, left, last, change);
        const float slope = last.x > left.x ? (last.y - left.y) / (last.x - left.x) : 0;
        if (left.x < 0) {
            const glm::vec2 border{0, left.y - left.x * slope};
            addWhole(row, left, border, change);
            left = border;
        }
        if (last.x > right)
            last = {right, left.y + (right - left.x) * slope};
        const glm::vec2 start = left;
        for (int column = int(left.x); left.x < last.x || column == int(start.x); ++column) {
            glm::vec2 next = last;
            if (float(column + 1) < last.x)
                next = {float(column + 1), start.y + (float(column + 1) - start.x) * slope};
            addInPixel(row, column, left, next, change);
            left = next;
        }
    }

    /// Of what lies left of the picture.
    void addWhole(std::size_t row, glm::vec2 a, glm::vec2 b, float change) {
        const Float4 all = beyond(a, b, change);
        sums_.addFrom(row, 0, all, all);
    }
    /// All that is right of a line, in pixels that it does not meet.
    static Float4 beyond(glm::vec2 a, glm::vec2 b, float change) {
        const float height = change * std::abs(b.y - a.y);
        return Float4{height, 0, height * 0.5f * (a.y + b.y), 0};
    }
    /// With x from the pixel's left side: ∫ (1 - x) dy, ∫ x (1 - x) / 2 dy and ∫ (1 - x) y dy.
    void addInPixel(std::size_t row, int column, glm::vec2 a, glm::vec2 b, float change) {
        a.x -= float(column);
        b.x -= float(column);
        const Float4 all = beyond(a, b, change);
        const float height = all[0], mean = 0.5f * (a.x + b.x),
                    squares = (a.x * a.x + a.x * b.x + b.x * b.x) / 3,
                    product = (2 * (a.x * a.y + b.x * b.y) + a.x * b.y + b.x * a.y) / 6;
        const Float4 here{height * (1 - mean), 0.5f * height * (mean - squares), all[2] - height * product,
                          0};
        sums_.addFrom(row, column, here, all);
    }

    int width_ = 0;
    Accumulator<Float4> sums_;
};

}  // namespace vtm::asset

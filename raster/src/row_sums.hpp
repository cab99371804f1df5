/// \file
/// Running sums along rows: every piece of boundary adds what changes at it, going along a row, to the pixels
/// that it meets (docs/coverage.md).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "raster/chord.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Running sums of 32-bit floats are off by less, and a share that small is no 1/255 of a pixel.
inline constexpr float minShare = 1e-5f;

inline bool isNothing(Float4 color) { return largest(color) < minShare; }
inline bool isNothing(float share) { return std::abs(share) < minShare; }

/// The changes of a band: of colours, or of the coverage of one paint.
template <class Value>
class Accumulator {
public:
    /// All is zero between pictures, so that a row as wide as before costs nothing to prepare.
    void resize(int width) {
        width_ = width;
        words_ = (std::size_t(width) + 2) / 64 + 2;
        changes_.resize(stride() * bandRows, Value{});
        touched_.resize(words_ * bandRows);
    }

    /// Adds what changes at a chord on the way along each row from left to right: `change` is the value on
    /// its left, going from a to b with y up, minus that on its right. `top`: the first row's y.
    void add(const Chord& chord, float top, int rows, Value change) {
        glm::vec2 a = chord.a, b = chord.b;
        a.y -= top;
        b.y -= top;
        // ∫ (1 - clamp(x)) dy along the chord is what the pixel has of its right side.
        if (isInRow(a.y, b.y, rows) && std::max(a.x, b.x) > 0)
            return addInRow(std::size_t(a.y), std::min(a.x, b.x), std::max(a.x, b.x), change * (a.y - b.y));
        if (a.y > b.y)
            std::swap(a, b);
        else
            change = -change;
        const float end = std::min(b.y, float(rows));
        float y = std::max(a.y, 0.0f);
        if (!(y < end))
            return;
        if (std::max(a.x, b.x) <= 0) [[unlikely]]
            return addLeft(y, end, change);
        const float slope = (b.x - a.x) / (b.y - a.y);
        float x = y > a.y ? a.x + (y - a.y) * slope : a.x;
        auto row = std::size_t(y);
        for (float nextY = float(row + 1); nextY < end; nextY += 1) {
            const float nextX = a.x + (nextY - a.y) * slope;
            addInRow(row++, std::min(x, nextX), std::max(x, nextX), change * (nextY - y));
            y = nextY;
            x = nextX;
        }
        const float lastX = end < b.y ? a.x + (end - a.y) * slope : b.x;
        addInRow(row, std::min(x, lastX), std::max(x, lastX), change * (end - y));
    }

    /// Adds to one pixel alone.
    void addPixel(std::size_t row, int x, Value value) {
        Value* changes = &changes_[row * stride()];
        touchFew(&touched_[row * words_], unsigned(x), 1);
        changes[x] += value;
        changes[x + 1] -= value;
    }
    /// Adds to a pixel, and to all that are right of it.
    void addFrom(std::size_t row, int x, Value here, Value beyond) {
        Value* changes = &changes_[row * stride()];
        touchFew(&touched_[row * words_], unsigned(x), 1);
        changes[x] += here;
        changes[x + 1] += beyond - here;
    }
    /// Adds valueOf(column), asked for in order, to pixels of a row.
    template <class ValueOf>
    void addPixels(std::size_t row, int first, int end, ValueOf&& valueOf) {
        Value* changes = &changes_[row * stride()];
        touch(row, unsigned(first), unsigned(end));
        Value before{};
        for (int x = first; x < end; ++x) {
            const Value value = valueOf(x);
            changes[x] += value - before;
            before = value;
        }
        changes[end] -= before;
    }

    /// Calls run(first column, end, value) for long stretches of one value of the row and some(first column,
    /// values) for up to four columns, in order, and clears it.
    template <class Run, class Some>
    void resolveFours(std::size_t row, Run&& run, Some&& some) {
        Value value{};
        Value* changes = &changes_[row * stride()];
        std::uint64_t* touched = &touched_[row * words_];
        int done = 0;
        for (std::size_t w = 0; w < words_; ++w)
            for (std::uint64_t bits = std::exchange(touched[w], 0); bits != 0;) {
                const int inWord = std::countr_zero(bits) & ~3, first = int(w * 64) + inWord;
                if (first >= width_)
                    break;
                bits &= ~(std::uint64_t(15) << inWord);
                if (first > done)
                    run(done, first, value);
                std::array<Value, 4> values;
                for (std::size_t i = 0; i < 4; ++i) {
                    Value& change = changes[std::size_t(first) + i];
                    values[i] = value += change;
                    change = Value{};
                }
                done = first + 4;
                some(first, std::span<const Value>(values).first(std::size_t(std::min(4, width_ - first))));
            }
        changes[width_] = changes[width_ + 1] = Value{};
        if (done < width_)
            run(done, width_, value);
    }
    /// Calls run(first column, end, value) for the row's stretches of one value, in order, and clears it.
    template <class Run>
    void resolve(std::size_t row, Run&& run) {
        resolve(row, 0, width_ + 1, run);  // what ends at the right border is added to two columns beyond it
    }
    /// The same of a row to which only columns first to end - 1 and the next one were added.
    template <class Run>
    void resolve(std::size_t row, int first, int end, Run&& run) {
        Value value{};
        Value* changes = &changes_[row * stride()];
        std::uint64_t* touched = &touched_[row * words_];
        const std::size_t lastWord = std::size_t(end) / 64;
        int done = 0;
        for (std::size_t w = std::size_t(first) / 64; w <= lastWord; ++w) {
            for (std::uint64_t bits = std::exchange(touched[w], 0); bits != 0; bits &= bits - 1) {
                const int column = int(w * 64) + std::countr_zero(bits);
                if (column >= width_)
                    break;
                if (column > done)
                    run(done, column, value);
                value += changes[column];
                done = column;
                changes[column] = Value{};
            }
        }
        changes[width_] = changes[width_ + 1] = Value{};
        if (done < width_)
            run(done, width_, value);
    }

private:
    std::size_t stride() const { return std::size_t(width_) + 4; }

    [[gnu::always_inline]] void touch(std::size_t row, unsigned first, unsigned last) {
        std::uint64_t* touched = &touched_[row * words_];
        for (; last - first >= 64; first += 63)
            touchFew(touched, first, 63);
        touchFew(touched, first, last - first);
    }
    static void touchFew(std::uint64_t* touched, unsigned first, unsigned more) {
        const std::uint64_t bits = (std::uint64_t(2) << more) - 1;
        const unsigned shift = first % 64;
        touched[first / 64] |= bits << shift;
        if (shift + more >= 64) [[unlikely]]
            touched[first / 64 + 1] |= bits >> 1 >> (63 - shift);
    }

    /// Whether two heights lie in one row of the band.
    static bool isInRow(float a, float b, int rows) {
        const int row = truncated(a);
        return row == truncated(b) && std::min(a, b) >= 0 && row >= 0 && row < rows;
    }

    /// What is left of the picture, from y to end, changes its first column. Not inlined: what is inside
    /// would pay.
    [[gnu::noinline]] void addLeft(float y, float end, Value change) {
        for (auto row = std::size_t(y); y < end; ++row) {
            const float nextY = std::min(float(row + 1), end);
            touched_[row * words_] |= 1;
            changes_[row * stride()] += change * (nextY - y);
            y = nextY;
        }
    }

    /// A straight line from x0 to x1 >= x0; `amount`: the change times the height.
    void addInRow(std::size_t row, float x0, float x1, Value amount) {
        if (x0 >= 0 && x1 <= float(width_))
            addInside(row, x0, x1, amount);
        else
            addCut(row, x0, x1, amount);
    }

    /// What is right of the picture changes nothing.
    void addCut(std::size_t row, float x0, float x1, Value amount) {
        const auto right = float(width_);
        if (x0 >= right)
            return;
        if (x1 <= 0)
            return addInside(row, 0, 0, amount);
        const float inverse = 1 / (x1 - x0);
        if (x0 < 0)
            addInside(row, 0, 0, amount * (-x0 * inverse));
        const float from = std::max(x0, 0.0f), to = std::min(x1, right);
        addInside(row, from, to, amount * ((to - from) * inverse));
    }

    void addInside(std::size_t row, float x0, float x1, Value amount) {
        const int first = int(x0), last = int(x1);
        Value* changes = &changes_[row * stride()];
        touch(row, unsigned(first), unsigned(last) + 1);
        if (first == last) {
            const Value later = amount * ((x0 + x1) * 0.5f - float(first));
            changes[first] += amount - later;
            changes[first + 1] += later;
            return;
        }
        // covered(i): what column i has of the amount, growing from 0 to 1.
        const float inverse = 1 / (x1 - x0), start = float(first + 1) - x0;
        float before = 0.5f * start * start * inverse;
        changes[first] += amount * before;
        for (int i = first + 1; i < last; ++i) {
            const float covered = (float(i) - x0 + 0.5f) * inverse;
            changes[i] += amount * (covered - before);
            before = covered;
        }
        const float rest = x1 - float(last);
        const float covered = 1 - 0.5f * rest * rest * inverse;
        changes[last] += amount * (covered - before);
        changes[last + 1] += amount * (1 - covered);
    }

    int width_ = 0;
    std::size_t words_ = 0;
    std::vector<Value> changes_;
    std::vector<std::uint64_t> touched_;
};

}  // namespace vtm::asset

/// \file
/// Running sums along rows: every piece of boundary adds what changes at it, going along a row, to the pixels
/// that it meets (docs/coverage.md).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "asset/planar_map.hpp"
#include "asset/view.hpp"

namespace vtm::asset {

/// Rows that are summed at a time: their changes stay in the cache.
inline constexpr int bandRows = 16;

/// A chord is nowhere further from its curve, pixels: 1/255 of a pixel's area at the very most. Chords lie on
/// both sides of the curve, so that what they miss cancels within a pixel where it holds more than one.
inline constexpr double chordTolerance = 1.0 / 256;

/// A piece with what does not depend on the view: how far it is from its chord, and how much it bends.
struct Boundary {
    PlanarPiece piece;
    double bulge, bend;

    explicit Boundary(const PlanarPiece& p) : piece(p), bulge(p.bulge()) {
        // |t''| is at most 4 |mA| + 2 |mB| at one end, the reverse at the other.
        const double a = std::abs(p.slopeA), b = std::abs(p.slopeB);
        bend = (4 * std::max(a, b) + 2 * std::min(a, b)) * glm::length(p.b - p.a);
    }
};

/// A straight part of a piece, in pixels, and the rows that it meets. Left and right are the pixels'.
struct Chord {
    glm::vec2 a, b;
    std::uint16_t left, right;
    std::uint16_t firstBand, lastBand;
};
static_assert(maxViewSide / bandRows < 65536);

// ---- Chords ---------------------------------------------------------------------------------------

/// Appends the chords of all pieces that can change a pixel of the view.
class Chords {
public:
    Chords(const Map& map, const View& view, std::vector<Chord>& chords)
        : width_(view.width), height_(view.height), chords_(chords) {
        const double step = map.side / double(latticeExtent);
        linear_ = glm::dmat2(view.toPixels[0] * step, view.toPixels[1] * step);
        origin_ = view.toPixels * glm::dvec3(map.x, map.y, 1);
        const double determinant = glm::determinant(linear_);
        mirrored_ = determinant < 0;
        // The largest singular value is at most this.
        stretch_ = std::sqrt(glm::dot(linear_[0], linear_[0]) + glm::dot(linear_[1], linear_[1]));
    }

    void add(const Boundary& boundary) {
        const PlanarPiece& piece = boundary.piece;
        const glm::dvec2 a = linear_ * piece.a + origin_, b = linear_ * piece.b + origin_;
        const double bulge = boundary.bulge * stretch_;
        if (std::max(a.y, b.y) + bulge <= 0 || std::min(a.y, b.y) - bulge >= height_ ||
            std::min(a.x, b.x) - bulge >= width_)
            return;
        // Over a step h of s a chord between points of the curve is off by h² |t''| / 8, by 2/3 of that in
        // the mean. Moved outwards by the mean, its points are off by h² |t''| / 12, and it is nowhere by
        // more.
        const double steps2 = boundary.bend * stretch_ / (12 * chordTolerance);
        if (steps2 <= 1)
            return addChord(glm::vec2(a), glm::vec2(b), piece);
        const int count = int(std::min(std::ceil(std::sqrt(steps2)), mostChords));
        const glm::dvec2 d = piece.b - piece.a, across = linear_ * glm::dvec2(-d.y, d.x);
        const double step = 1.0 / count, outwards = step * step / 12;
        glm::vec2 last(a);
        for (int i = 1; i < count; ++i) {
            const double s = i * step;
            const glm::vec2 next(a + s * (b - a) + (piece.height(s) - piece.bend(s) * outwards) * across);
            addChord(last, next, piece);
            last = next;
        }
        addChord(last, glm::vec2(b), piece);
    }

private:
    /// Of one piece: a quarter turn as long as the largest view has fewer.
    static constexpr double mostChords = 4096;

    void addChord(glm::vec2 a, glm::vec2 b, const PlanarPiece& piece) {
        const float top = std::min(a.y, b.y), bottom = std::max(a.y, b.y);
        if (top == bottom || bottom <= 0 || top >= float(height_) || std::min(a.x, b.x) >= float(width_))
            return;
        const auto band = [&](float y) {
            return std::uint16_t(int(std::clamp(y, 0.0f, float(height_ - 1))) / bandRows);
        };
        const auto left = std::uint16_t(mirrored_ ? piece.right : piece.left),
                   right = std::uint16_t(mirrored_ ? piece.left : piece.right);
        chords_.push_back({a, b, left, right, band(top), band(bottom)});
    }

    int width_, height_;
    std::vector<Chord>& chords_;
    glm::dmat2 linear_;
    glm::dvec2 origin_;
    bool mirrored_;
    double stretch_;
};

/// By band of rows: those of band i are numbers[first[i]] to numbers[first[i + 1]].
struct Bands {
    std::vector<std::uint32_t> first, next, numbers;

    void sort(const std::vector<Chord>& chords, int height) {
        const int count = (height + bandRows - 1) / bandRows;
        first.assign(std::size_t(count) + 1, 0);
        for (const Chord& c : chords)
            for (std::size_t band = c.firstBand; band <= c.lastBand; ++band)
                ++first[band + 1];
        for (std::size_t i = 1; i < first.size(); ++i)
            first[i] += first[i - 1];
        numbers.resize(first.back());
        next.assign(first.begin(), first.end() - 1);
        for (std::uint32_t i = 0; i < chords.size(); ++i)
            for (std::size_t band = chords[i].firstBand; band <= chords[i].lastBand; ++band)
                numbers[next[band]++] = i;
    }

    std::span<const std::uint32_t> of(int band) const {
        return {numbers.data() + first[std::size_t(band)], numbers.data() + first[std::size_t(band) + 1]};
    }
};

// ---- Sums -----------------------------------------------------------------------------------------

/// The changes of a band: `Value` is a colour, or the coverage of one paint.
template <class Value>
class Accumulator {
public:
    /// All is zero between pictures, so that a row as wide as before costs nothing to prepare.
    void resize(int width) {
        width_ = width;
        words_ = (std::size_t(width) + 2 + 63) / 64;
        changes_.resize(stride() * bandRows, Value(0));
        touched_.resize(words_ * bandRows);
    }

    /// Adds what changes at a chord on the way along each row from left to right: `change` is the value on
    /// its left, going from a to b with y up, minus that on its right. `top`: the first row's y.
    void add(const Chord& chord, float top, int rows, const Value& change) {
        glm::vec2 a = chord.a, b = chord.b;
        a.y -= top;
        b.y -= top;
        // ∫ (1 - clamp(x)) dy along the chord is what the pixel has of its right side.
        Value way = change * -1.0f;
        if (a.y > b.y) {
            std::swap(a, b);
            way = change;
        }
        const float from = std::max(a.y, 0.0f), to = std::min(b.y, float(rows));
        if (!(from < to))
            return;
        const float slope = (b.x - a.x) / (b.y - a.y);
        const auto at = [&](float y) { return y <= a.y ? a.x : y >= b.y ? b.x : a.x + (y - a.y) * slope; };
        float y = from, x = at(from);
        for (int row = int(from); y < to; ++row) {
            const float nextY = std::min(float(row + 1), to), nextX = at(nextY);
            addInRow(std::size_t(row), std::min(x, nextX), std::max(x, nextX), way * (nextY - y));
            y = nextY;
            x = nextX;
        }
    }

    /// Calls run(first column, end, value) for the row's stretches of one value, in order, and clears it.
    template <class Run>
    void resolve(std::size_t row, Run&& run) {
        Value value(0);
        Value* changes = &changes_[row * stride()];
        std::uint64_t* touched = &touched_[row * words_];
        int done = 0;
        for (std::size_t w = 0; w < words_; ++w) {
            for (std::uint64_t bits = touched[w]; bits != 0; bits &= bits - 1) {
                const int column = int(w * 64) + std::countr_zero(bits);
                if (column >= width_)
                    break;
                if (column > done)
                    run(done, column, value);
                value += changes[column];
                done = column;
                changes[column] = Value(0);
            }
            touched[w] = 0;
        }
        changes[width_] = changes[width_ + 1] = Value(0);
        if (done < width_)
            run(done, width_, value);
    }

private:
    std::size_t stride() const { return std::size_t(width_) + 2; }

    void touch(std::size_t row, int first, int last) {
        std::uint64_t* touched = &touched_[row * words_];
        for (int column = first; column <= last; ++column)
            touched[column / 64] |= std::uint64_t(1) << (column % 64);
    }

    /// A straight line from x0 to x1 >= x0; `amount`: the change times the height.
    void addInRow(std::size_t row, float x0, float x1, const Value& amount) {
        const auto right = float(width_);
        if (x0 < 0 || x1 > right) {
            if (x0 >= right)
                return;
            if (x1 <= 0)
                return addInRow(row, 0, 0, amount);
            // Cut at the borders: what is left of the picture changes its first column, what is right
            // nothing.
            const float inverse = 1 / (x1 - x0);
            if (x0 < 0)
                addInRow(row, 0, 0, amount * (-x0 * inverse));
            const float from = std::max(x0, 0.0f), to = std::min(x1, right);
            return addInRow(row, from, to, amount * ((to - from) * inverse));
        }
        Value* changes = &changes_[row * stride()];
        const int first = int(x0), last = int(x1);
        touch(row, first, last + 1);
        if (first == last) {
            const Value later = amount * ((x0 + x1) * 0.5f - float(first));
            changes[first] += amount - later;
            changes[first + 1] += later;
            return;
        }
        // covered(i): what pixel i has of the amount, growing from 0 to 1.
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

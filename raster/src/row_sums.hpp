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
#include <functional>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <vtm/raster/view.hpp>
#include "asset/instances.hpp"
#include "raster/chord.hpp"
#include "raster/planar_map.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Running sums of 32-bit floats are off by less, and a share that small is no 1/255 of a pixel.
inline constexpr float minShare = 1e-5f;

inline bool isNothing(Float4 color) { return largest(color) < minShare; }
inline bool isNothing(float share) { return std::abs(share) < minShare; }

/// Chords misplace no more of a pixel's area where an edge passes through it: 0.4 of a 255th.
inline constexpr double chordTolerance = 1.0 / 640;

/// A piece with what does not depend on the view: how far it is from its chord, and how much it bends.
///
/// **Chords.** Over a step h of s, a chord between points of the curve y = t(s) is off by h² |t''| / 12 in
/// the mean. If its ends are moved outwards by that, it covers exactly what the curve does, t'' being linear.
/// The piece's own ends stay where they are, so the first and the last chord, of which one end stays, are
/// shorter by √½. Then only the chords in which an edge enters and leaves a pixel misplace something: a part
/// of one up to 0.0080 h³ |t''| pixels if h is in pixels, of a first or last one 0.0087, and 0.0147 h³ of
/// what t'' changes by over half of the piece where its two ends bend by different amounts.
struct Boundary {
    PlanarPiece piece;
    double bulge;
    double bend;   ///< a single chord is off by so much in the mean, where a lattice step is a pixel
    double steps;  ///< and so many whole chords are needed, more than one

    explicit Boundary(const PlanarPiece& p) : piece(p), bulge(0), bend(0), steps(0) {
        if (p.slopeA == 0 && p.slopeB == 0)
            return;
        bulge = p.bulge();
        const glm::dvec2 chord = p.b - p.a;
        const double length2 = glm::dot(chord, chord), first = p.bend(0), last = p.bend(1);
        const double most = std::max(std::abs(first), std::abs(last));
        bend = most * std::sqrt(length2) / 12;
        constexpr double perCurve = 2 * 0.0087, perChange = 0.0147 / 2;
        steps = std::cbrt((perCurve * most + perChange * std::abs(last - first)) * length2 / chordTolerance);
    }
};

/// Chords by the band of rows that they meet; those of several bands are in each of them.
class Bands {
public:
    void clear(int height) {
        chords_.resize(std::size_t((height + bandRows - 1) / bandRows));
        for (std::vector<Chord>& band : chords_)
            band.clear();
    }
    /// Nothing if the chord changes no pixel of a picture of that size.
    void add(const Chord& chord, float width, float height) {
        const float top = std::min(chord.a.y, chord.b.y), bottom = std::max(chord.a.y, chord.b.y);
        if (top == bottom || bottom <= 0 || top >= height || std::min(chord.a.x, chord.b.x) >= width)
            return;
        const auto last = unsigned(std::min(bottom, height - 1)) / bandRows;
        for (unsigned band = unsigned(std::max(top, 0.0f)) / bandRows; band <= last; ++band)
            chords_[band].push_back(chord);
    }
    /// All of some, which lie in the picture between two heights.
    template <class Some>
    void addAll(const Some& chords, float top, float bottom, float width, float height) {
        const int band = int(top) / bandRows;
        if (band == int(bottom) / bandRows) {
            chords_[std::size_t(band)].insert(of(band).end(), chords.begin(), chords.end());
        } else {
            for (const Chord& chord : chords)
                add(chord, width, height);
        }
    }
    std::vector<Chord>& of(int band) { return chords_[std::size_t(band)]; }
    /// Takes the place of those of a band, which `chords` gets.
    void exchange(int band, std::vector<Chord>& chords) { chords_[std::size_t(band)].swap(chords); }

private:
    std::vector<std::vector<Chord>> chords_;
};

// ---- Chords ---------------------------------------------------------------------------------------

/// From the picture's plane to pixels.
inline Affine2 toPixelsOf(const View& view) {
    return {glm::dmat2(view.toPixels[0], view.toPixels[1]), view.toPixels[2]};
}

/// Makes the chords of pieces, and passes each on by take(chord).
template <class Take>
class Chords {
public:
    /// `toPixels` leads from lattice coordinates to the pixels of a picture of that size.
    Chords(const Affine2& toPixels, glm::ivec2 size, Take take)
        : width_(float(size.x)),
          height_(float(size.y)),
          linear_(toPixels.linear),
          origin_(toPixels.offset),
          take_(std::move(take)) {
        const double determinant = glm::determinant(linear_);
        mirrored_ = determinant < 0;
        // The largest singular value.
        const double x = glm::dot(linear_[0], linear_[0]), y = glm::dot(linear_[1], linear_[1]);
        stretch_ = std::sqrt(0.5 * (x + y) + std::hypot(0.5 * (x - y), glm::dot(linear_[0], linear_[1])));
        areaRoot_ = std::cbrt(stretch_ * stretch_);
    }

    /// The side of the smallest square whose image can be as long as a pixel, lattice steps.
    double pixel() const { return 1 / stretch_; }
    /// False if nothing in that box changes a pixel.
    bool mayMatter(glm::dvec2 min, glm::dvec2 max) const {
        const PixelReach reach = reachOf(min, max);
        return reach.max.y > 0 && reach.min.y < height_ && reach.min.x < width_;
    }
    /// Whether something in that box is in a pixel.
    bool mayShow(glm::dvec2 min, glm::dvec2 max) const {
        return mayMatter(min, max) && reachOf(min, max).max.x > 0;
    }

    /// Nothing if it changes no pixel.
    void add(const Boundary& boundary) {
        const glm::dvec2 a = linear_ * boundary.piece.a + origin_, b = linear_ * boundary.piece.b + origin_;
        const double bulge = boundary.bulge * stretch_;
        if (std::max(a.y, b.y) + bulge <= 0 || std::min(a.y, b.y) - bulge >= height_ ||
            std::min(a.x, b.x) - bulge >= width_)
            return;
        // What is left of the picture changes a row as much as its height there, whatever its shape.
        if (std::max(a.x, b.x) + bulge <= 0)
            return addChord(glm::vec2(a), glm::vec2(b), boundary.piece);
        addBetween(a, b, boundary);
    }
    /// Wherever it is.
    void addAnywhere(const Boundary& boundary) {
        addBetween(linear_ * boundary.piece.a + origin_, linear_ * boundary.piece.b + origin_, boundary);
    }

private:
    /// Of one piece: a quarter turn as long as the largest view has fewer.
    static constexpr double maxChords = 4096;

    /// The box around the image of a box.
    struct PixelReach {
        glm::dvec2 min, max;
    };
    PixelReach reachOf(glm::dvec2 min, glm::dvec2 max) const {
        const glm::dvec2 centre = linear_ * (0.5 * (min + max)) + origin_;
        const glm::dvec2 half = 0.5 * (max - min);
        const glm::dvec2 reach = glm::abs(linear_[0]) * half.x + glm::abs(linear_[1]) * half.y;
        return {centre - reach, centre + reach};
    }

    void addBetween(glm::dvec2 a, glm::dvec2 b, const Boundary& boundary) {
        if (boundary.bend * stretch_ <= chordTolerance)
            return addChord(glm::vec2(a), glm::vec2(b), boundary.piece);
        // The first and the last one are as long as √2 whole ones.
        const double others = boundary.steps * areaRoot_ - std::numbers::sqrt2;
        addChords(2 + int(std::ceil(std::clamp(others, 0.0, maxChords))), a, b, boundary.piece);
    }

    void addChords(int count, glm::dvec2 a, glm::dvec2 b, const PlanarPiece& piece) {
        // t - outwards t'' as a polynomial of s.
        const double step = 1 / (count - 2 + std::numbers::sqrt2), outwards = step * step / 12;
        const double c3 = piece.slopeA + piece.slopeB, c2 = -piece.slopeA - c3;
        const double c1 = piece.slopeA - 6 * outwards * c3, c0 = -2 * outwards * c2;
        const glm::dvec2 d = piece.b - piece.a, across = linear_ * glm::dvec2(-d.y, d.x);
        const glm::dvec2 p0 = a + c0 * across, p1 = b - a + c1 * across, p2 = c2 * across, p3 = c3 * across;
        glm::vec2 last(a);
        for (int i = 1; i < count; ++i) {
            const double s = (i - 1 + 0.5 * std::numbers::sqrt2) * step;
            const glm::vec2 next(p0 + s * (p1 + s * (p2 + s * p3)));
            addChord(last, next, piece);
            last = next;
        }
        addChord(last, glm::vec2(b), piece);
    }

    void addChord(glm::vec2 a, glm::vec2 b, const PlanarPiece& piece) {
        take_({a, b, mirrored_ ? piece.right : piece.left, mirrored_ ? piece.left : piece.right});
    }

    float width_, height_;
    glm::dmat2 linear_;
    glm::dvec2 origin_;
    bool mirrored_;
    double stretch_, areaRoot_;
    Take take_;
};

/// The chords of all pieces that can change a pixel of the view, by bands. `paintOf`: from the paints of
/// pieces to the picture's.
template <class PaintOf = std::identity>
auto chordsOf(const Affine2& toPicture, const View& view, Bands& bands, PaintOf paintOf = {}) {
    const glm::vec2 size(view.width, view.height);
    return Chords(compose(toPixelsOf(view), toPicture), {view.width, view.height}, [=, &bands](Chord chord) {
        chord.left = paintOf(chord.left);
        chord.right = paintOf(chord.right);
        bands.add(chord, size.x, size.y);
    });
}
inline auto chordsOf(const MapPlace& map, const View& view, Bands& bands) {
    return chordsOf({glm::dmat2(map.side / map.extent), map.origin}, view, bands);
}

// ---- Sums -----------------------------------------------------------------------------------------

/// How an amount is added to a pixel: `Value` is a Float4, or the coverage of one paint.
template <class V>
struct Wholes {
    using Value = V;
    using Amount = V;
    static constexpr unsigned perSide = 1;

    static void add(Value* row, unsigned, int column, Amount amount) { row[column] += amount; }
};

/// Coverage by quarters of pixels: left and right of the upper half, then of the lower one.
struct Quarters {
    using Value = Float4;
    using Amount = float;
    static constexpr unsigned perSide = 2;

    /// `row`: of pixels, `half` of it; what changes in a right quarter changes the left one of the next
    /// pixel.
    static void add(Value* row, unsigned half, int column, Amount amount) {
        static constexpr Float4 here[4]{{1, 1, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}, {0, 0, 0, 1}};
        static constexpr Float4 next[4]{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}};
        const unsigned part = 2 * half + unsigned(column) % 2;
        row[column / 2] += amount * here[part];
        row[column / 2 + 1] += amount * next[part];
    }
};

/// The changes of a band, summed on a grid of `perSide` rows and columns a pixel.
template <class Grid>
class Accumulator {
    using Value = typename Grid::Value;
    using Amount = typename Grid::Amount;
    static constexpr unsigned perSide = Grid::perSide;

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
    void add(const Chord& chord, float top, int rows, Amount change) {
        glm::vec2 a = float(perSide) * chord.a, b = float(perSide) * chord.b;
        // ∫ (1 - clamp(x)) dy along the chord is what the pixel has of its right side.
        if (a.y > b.y)
            std::swap(a, b);
        else
            change = -change;
        a.y -= float(perSide) * top;
        b.y -= float(perSide) * top;
        const float end = std::min(b.y, float(perSide) * float(rows));
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
        Value value{};
        Value* changes = &changes_[row * stride()];
        std::uint64_t* touched = &touched_[row * words_];
        int done = 0;
        for (std::size_t w = 0; w < words_; ++w) {
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
        touched[first / 64 + 1] |= bits >> 1 >> (63 - shift);
    }

    /// What is left of the picture, from y to end, changes its first column. Not inlined: what is inside
    /// would pay.
    [[gnu::noinline]] void addLeft(float y, float end, Amount change) {
        for (auto row = std::size_t(y); y < end; ++row) {
            const float nextY = std::min(float(row + 1), end);
            touched_[row / perSide * words_] |= 1;
            Grid::add(&changes_[row / perSide * stride()], unsigned(row % perSide), 0, change * (nextY - y));
            y = nextY;
        }
    }

    /// A straight line from x0 to x1 >= x0; `amount`: the change times the height.
    void addInRow(std::size_t row, float x0, float x1, Amount amount) {
        if (x0 >= 0 && x1 <= float(perSide) * float(width_))
            addInside(row, x0, x1, amount);
        else
            addCut(row, x0, x1, amount);
    }

    /// What is right of the picture changes nothing.
    void addCut(std::size_t row, float x0, float x1, Amount amount) {
        const auto right = float(perSide) * float(width_);
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

    void addInside(std::size_t row, float x0, float x1, Amount amount) {
        const int first = int(x0), last = int(x1);
        Value* changes = &changes_[row / perSide * stride()];
        const auto add = [&](int column, Amount change) {
            Grid::add(changes, unsigned(row % perSide), column, change);
        };
        touch(row / perSide, unsigned(first) / perSide, unsigned(last) / perSide + 1);
        if (first == last) {
            const Amount later = amount * ((x0 + x1) * 0.5f - float(first));
            add(first, amount - later);
            return add(first + 1, later);
        }
        // covered(i): what column i has of the amount, growing from 0 to 1.
        const float inverse = 1 / (x1 - x0), start = float(first + 1) - x0;
        float before = 0.5f * start * start * inverse;
        add(first, amount * before);
        for (int i = first + 1; i < last; ++i) {
            const float covered = (float(i) - x0 + 0.5f) * inverse;
            add(i, amount * (covered - before));
            before = covered;
        }
        const float rest = x1 - float(last);
        const float covered = 1 - 0.5f * rest * rest * inverse;
        add(last, amount * (covered - before));
        add(last + 1, amount * (1 - covered));
    }

    int width_ = 0;
    std::size_t words_ = 0;
    std::vector<Value> changes_;
    std::vector<std::uint64_t> touched_;
};

}  // namespace vtm::asset

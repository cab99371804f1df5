/// \file
/// The chords of boundaries under a view, by bands of rows.
#pragma once

#include <algorithm>
#include <array>
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
#include "raster/src/boundaries.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Chords by the band of rows that they meet; those of several bands are in each of them. They are written
/// part by part: a whole one would be read again before its parts have reached the memory, which stalls.
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
            chords_[band].emplace_back(chord.a, chord.b, chord.left, chord.right);
    }
    /// Those from one point to the next. Most lie in the band of the one before.
    void add(std::span<const glm::vec2> points, std::uint32_t left, std::uint32_t right, float width,
             float height) {
        glm::vec2 a = points[0];
        Rows rows = rowsOf(a.y, height);
        for (const glm::vec2& b : points.subspan(1)) {
            if (!rows.hold(b.y)) {
                add({a, b, left, right}, width, height);
                rows = rowsOf(b.y, height);
            } else if (std::min(a.x, b.x) < width) {
                rows.band->emplace_back(a, b, left, right);
            }
            a = b;
        }
    }
    /// All of some, which lie in the picture between two heights. None is level.
    template <class Some>
    void addAll(const Some& chords, float top, float bottom) {
        const unsigned band = unsigned(top) / bandRows;
        if (band == unsigned(bottom) / bandRows) {
            chords_[band].insert(chords_[band].end(), chords.begin(), chords.end());
            return;
        }
        for (const Chord& chord : chords) {
            const unsigned a = unsigned(chord.a.y) / bandRows, b = unsigned(chord.b.y) / bandRows;
            for (unsigned i = std::min(a, b); i <= std::max(a, b); ++i)
                chords_[i].push_back(chord);
        }
    }
    std::span<const Chord> of(int band) const { return chords_[std::size_t(band)]; }

private:
    /// A band, and the heights in it.
    struct Rows {
        float top = 0, bottom = 0;
        std::vector<Chord>* band = nullptr;

        bool hold(float y) const { return y >= top && y < bottom; }
    };
    /// Of the band that a height is in; none beside the picture.
    Rows rowsOf(float y, float height) {
        if (!(y >= 0 && y < height))
            return {};
        const unsigned band = unsigned(y) / bandRows;
        return {float(band * bandRows), std::min(float((band + 1) * bandRows), height), &chords_[band]};
    }

    std::vector<std::vector<Chord>> chords_;
};

/// From the picture's plane to pixels.
inline Affine2 toPixelsOf(const View& view) {
    return {glm::dmat2(view.toPixels[0], view.toPixels[1]), view.toPixels[2]};
}

/// Makes the chords of pieces, and passes them on by take(points, left, right): from one point to the next.
template <class Take>
class Chords {
public:
    /// `toPixels` leads from lattice coordinates to the pixels of a picture of that size.
    Chords(const Affine2& toPixels, glm::ivec2 size, Take take)
        : width_(float(size.x)),
          height_(float(size.y)),
          right_(double2(toPixels.linear[0])),
          down_(double2(toPixels.linear[1])),
          origin_(double2(toPixels.offset)),
          take_(std::move(take)) {
        const glm::dmat2& linear = toPixels.linear;
        mirrored_ = glm::determinant(linear) < 0;
        // The largest singular value.
        const double x = glm::dot(linear[0], linear[0]), y = glm::dot(linear[1], linear[1]);
        stretch_ = std::sqrt(0.5 * (x + y) + std::hypot(0.5 * (x - y), glm::dot(linear[0], linear[1])));
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

    /// Nothing of curves that change no pixel.
    void add(const Boundaries& boundaries) {
        addPolylines(boundaries);
        for (const Boundary& curve : boundaries.curves())
            add(curve);
    }
    /// Wherever they are.
    void addAnywhere(const Boundaries& boundaries) {
        addPolylines(boundaries);
        for (const Boundary& curve : boundaries.curves())
            addBetween(place(curve.piece.a), place(curve.piece.b), curve);
    }

private:
    /// Of one piece: a quarter turn as long as the largest view has fewer.
    static constexpr double maxChords = 4096;
    /// So many points are passed on together.
    static constexpr std::size_t maxPoints = 32;

    /// What takes their chords looks where they are.
    void addPolylines(const Boundaries& boundaries) {
        std::array<glm::vec2, maxPoints> placed;
        boundaries.forEachPolyline(
            [&](std::span<const glm::dvec2> points, std::uint32_t left, std::uint32_t right) {
                for (std::size_t first = 0; first + 1 < points.size(); first += maxPoints - 1) {
                    const std::size_t count = std::min(points.size() - first, maxPoints);
                    for (std::size_t i = 0; i < count; ++i)
                        placed[i] = toFloats(place(points[first + i]));
                    take(std::span(placed).first(count), left, right);
                }
            });
    }
    void add(const Boundary& boundary) {
        const Double2 a = place(boundary.piece.a), b = place(boundary.piece.b);
        const double bulge = boundary.bulge * stretch_;
        const Double2 low = (a < b ? a : b) - bulge, high = (a < b ? b : a) + bulge;
        if (high[1] <= 0 || low[1] >= height_ || low[0] >= width_)
            return;
        // What is left of the picture changes a row as much as its height there, whatever its shape.
        if (high[0] <= 0)
            return addChord(a, b, boundary.piece);
        addBetween(a, b, boundary);
    }
    /// The box around the image of a box.
    struct PixelReach {
        glm::dvec2 min, max;
    };
    PixelReach reachOf(glm::dvec2 min, glm::dvec2 max) const {
        const Double2 centre = place(0.5 * (min + max));
        const glm::dvec2 half = 0.5 * (max - min);
        const Double2 x = right_ * half.x, y = down_ * half.y;
        const Double2 reach = (x < 0 ? -x : x) + (y < 0 ? -y : y);
        const Double2 low = centre - reach, high = centre + reach;
        return {{low[0], low[1]}, {high[0], high[1]}};
    }

    Double2 place(glm::dvec2 point) const { return right_ * point.x + down_ * point.y + origin_; }

    void addBetween(Double2 a, Double2 b, const Boundary& boundary) {
        if (boundary.bend * stretch_ <= chordTolerance)
            return addChord(a, b, boundary.piece);
        // The first and the last one are as long as √2 whole ones.
        const double others = boundary.steps * areaRoot_ - std::numbers::sqrt2;
        addChords(2 + int(std::ceil(std::clamp(others, 0.0, maxChords))), a, b, boundary.piece);
    }

    void addChords(int count, Double2 a, Double2 b, const PlanarPiece& piece) {
        // t - outwards t'' as a polynomial of s.
        const double step = 1 / (count - 2 + std::numbers::sqrt2), outwards = step * step / 12;
        const double c3 = piece.slopeA + piece.slopeB, c2 = -piece.slopeA - c3;
        const double c1 = piece.slopeA - 6 * outwards * c3, c0 = -2 * outwards * c2;
        const glm::dvec2 d = piece.b - piece.a;
        const Double2 across = down_ * d.x - right_ * d.y;
        const Double2 p0 = a + c0 * across, p1 = b - a + c1 * across, p2 = c2 * across, p3 = c3 * across;
        std::array<glm::vec2, maxPoints> points;
        points[0] = toFloats(a);
        std::size_t made = 1;
        for (int i = 1; i < count; ++i) {
            if (made == points.size() - 1) {  // room for the last one stays
                take(std::span(points).first(made), piece.left, piece.right);
                points[0] = points[made - 1];
                made = 1;
            }
            const double s = (i - 1 + 0.5 * std::numbers::sqrt2) * step;
            points[made++] = toFloats(p0 + s * (p1 + s * (p2 + s * p3)));
        }
        points[made++] = toFloats(b);
        take(std::span(points).first(made), piece.left, piece.right);
    }

    void addChord(Double2 a, Double2 b, const PlanarPiece& piece) {
        const std::array<glm::vec2, 2> ends{toFloats(a), toFloats(b)};
        take(ends, piece.left, piece.right);
    }
    void take(std::span<const glm::vec2> points, std::uint32_t left, std::uint32_t right) {
        take_(points, mirrored_ ? right : left, mirrored_ ? left : right);
    }

    float width_, height_;
    Double2 right_, down_, origin_;
    bool mirrored_;
    double stretch_, areaRoot_;
    Take take_;
};

/// The chords of all pieces that can change a pixel of the view, by bands. `paintOf`: from the paints of
/// pieces to the picture's.
template <class PaintOf = std::identity>
auto chordsOf(const Affine2& toPicture, const View& view, Bands& bands, PaintOf paintOf = {}) {
    const glm::vec2 size(view.width, view.height);
    return Chords(compose(toPixelsOf(view), toPicture), {view.width, view.height},
                  [=, &bands](std::span<const glm::vec2> points, std::uint32_t left, std::uint32_t right) {
                      bands.add(points, paintOf(left), paintOf(right), size.x, size.y);
                  });
}
inline auto chordsOf(const MapPlace& map, const View& view, Bands& bands) {
    return chordsOf({glm::dmat2(map.side / map.extent), map.origin}, view, bands);
}

}  // namespace vtm::asset

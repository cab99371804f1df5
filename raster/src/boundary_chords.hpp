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
#include "raster/src/float4.hpp"

namespace vtm::asset {

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
    /// Those from one point to the next.
    void add(std::span<const glm::vec2> points, std::uint32_t left, std::uint32_t right, float width,
             float height) {
        if (points.size() > 2)
            if (std::vector<Chord>* band = onlyBand(points, height)) {
                for (std::size_t i = 1; i < points.size(); ++i)
                    band->push_back({points[i - 1], points[i], left, right});
                return;
            }
        for (std::size_t i = 1; i < points.size(); ++i)
            add({points[i - 1], points[i], left, right}, width, height);
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
    /// The one in which all points are, null if there is none.
    std::vector<Chord>* onlyBand(std::span<const glm::vec2> points, float height) {
        float top = points[0].y, bottom = top;
        for (const glm::vec2& point : points.subspan(1)) {
            top = std::min(top, point.y);
            bottom = std::max(bottom, point.y);
        }
        if (!(top >= 0 && bottom < height))
            return nullptr;
        const unsigned band = unsigned(top) / bandRows;
        return band == unsigned(bottom) / bandRows ? &chords_[band] : nullptr;
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

    /// Nothing if it changes no pixel.
    void add(const Boundary& boundary) {
        const Double2 a = place(boundary.piece.a), b = place(boundary.piece.b);
        if (boundary.bend == 0)  // what takes the chord looks where it is
            return addChord(a, b, boundary.piece);
        const double bulge = boundary.bulge * stretch_;
        const Double2 low = (a < b ? a : b) - bulge, high = (a < b ? b : a) + bulge;
        if (high[1] <= 0 || low[1] >= height_ || low[0] >= width_)
            return;
        // What is left of the picture changes a row as much as its height there, whatever its shape.
        if (high[0] <= 0)
            return addChord(a, b, boundary.piece);
        addBetween(a, b, boundary);
    }
    /// Wherever it is.
    void addAnywhere(const Boundary& boundary) {
        addBetween(place(boundary.piece.a), place(boundary.piece.b), boundary);
    }

private:
    /// Of one piece: a quarter turn as long as the largest view has fewer.
    static constexpr double maxChords = 4096;

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
        std::array<glm::vec2, 32> points;
        points[0] = toFloats(a);
        std::size_t made = 1;
        for (int i = 1; i < count; ++i) {
            if (made == points.size() - 1) {  // room for the last one stays
                take(std::span(points).first(made), piece);
                points[0] = points[made - 1];
                made = 1;
            }
            const double s = (i - 1 + 0.5 * std::numbers::sqrt2) * step;
            points[made++] = toFloats(p0 + s * (p1 + s * (p2 + s * p3)));
        }
        points[made++] = toFloats(b);
        take(std::span(points).first(made), piece);
    }

    void addChord(Double2 a, Double2 b, const PlanarPiece& piece) {
        const std::array<glm::vec2, 2> ends{toFloats(a), toFloats(b)};
        take(ends, piece);
    }
    void take(std::span<const glm::vec2> points, const PlanarPiece& piece) {
        take_(points, mirrored_ ? piece.right : piece.left, mirrored_ ? piece.left : piece.right);
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

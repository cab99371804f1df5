/// \file
/// The boundaries of a square as the scanner keeps them: straight pieces that follow each other as polylines,
/// and curves with what does not depend on the view.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "raster/planar_map.hpp"

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

    explicit Boundary(const PlanarPiece& p) : piece(p), bulge(p.bulge()) {
        const glm::dvec2 chord = p.b - p.a;
        const double length2 = glm::dot(chord, chord), first = p.bend(0), last = p.bend(1);
        const double most = std::max(std::abs(first), std::abs(last));
        bend = most * std::sqrt(length2) / 12;
        constexpr double perCurve = 2 * 0.0087, perChange = 0.0147 / 2;
        steps = std::cbrt((perCurve * most + perChange * std::abs(last - first)) * length2 / chordTolerance);
    }
};

/// Of a square, or of a line between squares. Their order changes what is drawn by rounding alone.
class Boundaries {
public:
    Boundaries() = default;
    explicit Boundaries(std::span<const PlanarPiece> pieces) {
        for (const PlanarPiece& piece : pieces)
            add(piece);
    }

    /// Asks for the first of them, so that they are in the cache when they are read soon after. Those that
    /// follow come by themselves.
    void prefetch() const {
        constexpr std::size_t lineBytes = 64, lines = 4;
        for (std::size_t offset = 0; offset < lines * lineBytes; offset += lineBytes) {
            __builtin_prefetch(reinterpret_cast<const char*>(points_.data()) + offset);
            __builtin_prefetch(reinterpret_cast<const char*>(curves_.data()) + offset);
        }
        __builtin_prefetch(polylines_.data());
    }
    bool empty() const { return size_ == 0; }
    /// How many pieces they are.
    std::size_t size() const { return size_; }
    std::span<const Boundary> curves() const { return curves_; }
    /// Calls visit(points, left paint, right paint) for each polyline.
    template <class Visit>
    void forEachPolyline(Visit&& visit) const {
        std::size_t first = 0;
        for (const Polyline& line : polylines_) {
            visit(std::span(points_).subspan(first, line.end - first), line.left, line.right);
            first = line.end;
        }
    }
    /// All pieces, the straight ones first.
    std::vector<PlanarPiece> pieces() const {
        std::vector<PlanarPiece> pieces;
        pieces.reserve(size_);
        forEachPolyline([&](std::span<const glm::dvec2> points, std::uint32_t left, std::uint32_t right) {
            for (std::size_t i = 1; i < points.size(); ++i)
                pieces.push_back({points[i - 1], points[i], 0, 0, left, right});
        });
        for (const Boundary& curve : curves_)
            pieces.push_back(curve.piece);
        return pieces;
    }

private:
    struct Polyline {
        std::size_t end;  ///< of its points
        std::uint32_t left, right;
    };

    void add(const PlanarPiece& piece) {
        ++size_;
        if (piece.slopeA != 0 || piece.slopeB != 0) {
            curves_.emplace_back(piece);
            return;
        }
        if (polylines_.empty() || polylines_.back().left != piece.left ||
            polylines_.back().right != piece.right || points_.back() != piece.a) {
            points_.push_back(piece.a);
            polylines_.push_back({points_.size(), piece.left, piece.right});
        }
        points_.push_back(piece.b);
        polylines_.back().end = points_.size();
    }

    std::vector<glm::dvec2> points_;
    std::vector<Polyline> polylines_;
    std::vector<Boundary> curves_;
    std::size_t size_ = 0;
};

}  // namespace vtm::asset

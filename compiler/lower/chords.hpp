/// \file
/// A path as lines and cubic Béziers, and cubics as chords, as few as the tolerance allows.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include "compiler/lower/area_chords.hpp"
#include "compiler/lower/even_shares.hpp"
#include "geometry/cubic.hpp"

namespace vtm::compiler {

using geometry::Cubic;

/// Receives closed contours: start, then lines and cubics, each from where the last one ended; the
/// last one of a contour ends at its start.
class CurveSink {
public:
    virtual ~CurveSink() = default;
    virtual void start(scene::Point p) = 0;
    virtual void line(scene::Point to) = 0;
    virtual void cubic(const Cubic& c) = 0;
};

/// Coordinates of the map beyond this are pulled in to it, far outside any picture, so that
/// differences and products stay finite.
inline constexpr double farAway = 1e100;
scene::Affine withoutFarAway(scene::Affine map);

/// Walks `path` under `map`; open subpaths are closed by a line. Quadratics are raised to cubics,
/// exactly; elliptical arcs become cubics within `arcTolerance` under the map, or of a 32nd of a turn if that
/// is infinite, within 1.1e-9 of their radius.
void walkCurves(const scene::Path& path, const scene::Affine& map, CurveSink& sink,
                double arcTolerance = std::numeric_limits<double>::infinity());

/// Cuts cubics where all their chords stray about equally far. A curve and its reverse are cut at the same
/// places. Keeps its memory from curve to curve.
///
/// Over a small step h of the parameter the curve P strays from its chord by h² |P' × P''| / (8 |P'|). So
/// sqrt(|P' × P''| / (8 |P'| tolerance)) chords are needed per unit of t, and steps with equal shares of its
/// integral make the fewest. What is guessed so is then proven, or halved.
class ChordCutter {
public:
    /// Guessed for one cubic.
    static constexpr int maxChords = 256;

    explicit ChordCutter(ChordTolerance tolerance)
        : tolerance_(tolerance.distance), area_(tolerance.area), perTurn_(1 / tolerance.turn) {}

    /// The ends of chords within the tolerance, the last one that of the cubic. Empty if they would be too
    /// many, or the cubic is infinite, or so large that doubles do not resolve the tolerance, or chords of
    /// that area are not proven. Valid until the next call.
    std::span<const scene::Point> cut(const Cubic& cubic);

private:
    using Point = scene::Point;
    /// By powers of its parameter: P = ((a t + b) t + c) t + start.
    struct Curve {
        Point a, b, c, start;

        Point at(double t) const { return ((a * t + b) * t + c) * t + start; }
        Point velocity(double t) const { return (3.0 * a * t + 2.0 * b) * t + c; }
    };
    /// Of one number or of two at once.
    template <class Number>
    struct Vertex {
        Number t, x, y;
    };
    /// The proof of a chord.
    struct Proof;
    struct Across;

    std::span<const Point> cutByArea(Point end);
    double guess();
    double guessByArea();
    bool isResolved() const;
    void findVertices(int count, Point end, double endShare);
    bool areNearByArea(int count) const;
    bool runsForward(double t0, double t1) const;
    bool runForward(int first, int last) const;
    void appendChords(int count);
    void appendVertices(int first, int last);
    void chord(const Vertex<double>& from, const Vertex<double>& to, int halvings);
    void halves(const Vertex<double>& from, const Vertex<double>& to, int halvings);

    const double tolerance_, area_, perTurn_;
    Curve curve_;
    EvenShares shares_;
    /// Vertices, and one more for loops over two at once.
    std::array<double, maxChords + 2> t_, x_, y_;
    bool runForward_ = false;  ///< all chords, proven
    std::vector<Point> ends_;
};

}  // namespace vtm::compiler

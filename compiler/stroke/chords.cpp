#include "compiler/stroke/chords.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "compiler/lower/even_shares.hpp"
#include "compiler/stroke/roots.hpp"
#include "compiler/stroke/stretch.hpp"

namespace vtm::compiler::stroke {
namespace {

/// Halvings of a chord that was guessed too long.
constexpr int maxChordHalvings = 12;
/// Chords of a curve; where more are guessed, halving makes them.
constexpr double maxDensity = 4096;
/// Of these, so many are placed at once.
constexpr int maxChords = 256;

/// One coordinate of a curve and its velocity at two places.
struct Coordinate {
    Pair a, b, c, start, a3, b2;

    Coordinate(double cubed, double squared, double linear, double constant)
        : a{cubed, cubed},
          b{squared, squared},
          c{linear, linear},
          start{constant, constant},
          a3(3 * a),
          b2(2 * b) {}
    Pair at(Pair t) const { return ((a * t + b) * t + c) * t + start; }
    Pair slope(Pair t) const { return (a3 * t + b2) * t + c; }
};

class ChordOffset {
public:
    ChordOffset(const Cubic& curve, double distance, ChordTolerance tolerance, Side& side)
        : curve_(curve),
          powers_(curve),
          xs_(powers_.cubed.x, powers_.squared.x, powers_.linear.x, powers_.start.x),
          ys_(powers_.cubed.y, powers_.squared.y, powers_.linear.y, powers_.start.y),
          distance_(distance),
          tolerance_(tolerance.distance),
          area_(tolerance.area),
          side_(side) {}

    void run(double t0, double t1) {
        const std::array<double, 3> turns = curvature(curve_).cross;
        const auto [minimum, maximum] = std::minmax({turns[0], turns[1], turns[2]});
        double from = t0;
        if (minimum < 0 && maximum > 0)
            for (const double inflection : rootsInside(powers(turns)))
                if (inflection > t0 && inflection < t1) {
                    convex(from, inflection);
                    from = inflection;
                }
        convex(from, t1);
    }

private:
    struct Vertex {
        double t;
        Point at, along;  ///< of any length
    };
    /// Two vertices.
    struct Vertices {
        Pair x, y, alongX, alongY;
    };

    Vertex vertex(double t) const {
        const Point velocity = powers_.velocity(t);
        const bool isInside = t > 0 && t < 1 && velocity != Point{0, 0};
        const Point along = isInside ? unit(velocity) : tangentAt(curve_, t);
        return {t, (isInside ? powers_.at(t) : curve_.at(t)) + perp(along) * distance_, along};
    }

    /// Inside the curve.
    Vertices vertices(Pair t) const {
        constexpr double minimum = 1e-280;  // smaller squares lose digits; the vertex becomes infinite
        const Pair x = xs_.slope(t), y = ys_.slope(t), square = x * x + y * y;
        const Pair share = distance_ / squareRoot(square > minimum ? square : 0.0);
        return {xs_.at(t) - y * share, ys_.at(t) + x * share, x, y};
    }

    /// The number of chords in [from, to] if each of them has an equal share of it: divided by dt, a chord
    /// strays by a quarter of its length times half its turn, both of which grow with dt.
    double guess(double from, double to) {
        // Of the tolerance: the tangent strays a little farther than the curve, and a chord that reaches the
        // limit costs pieces later.
        constexpr double sure = 0.8;
        const auto& [a, b, c, start] = powers_;
        const double c0 = 2 * cross(c, b), c1 = 6 * cross(c, a), c2 = -6 * cross(a, b);  // P' × P''
        const double per = 1 / (8 * sure * tolerance_);
        return shares_.integrate(from, to, [=, this](Pair t) {
            const Pair x = xs_.slope(t), y = ys_.slope(t), square = x * x + y * y;
            const Pair turn = ((c2 * t + c1) * t + c0) / square;
            const Pair chords = squareRoot(per * magnitude((squareRoot(square) - distance_ * turn) * turn));
            return chords < maxDensity ? chords : 0.0;
        });
    }

    /// Between which the curve has no inflection.
    void convex(double from, double to) {
        area_ > 0 ? byArea(from, to, maxChordHalvings) : byDistance(from, to);
    }

    /// The number of whole chords (compiler/lower/area_chords.hpp): κ is the turn by the speed.
    double guessByArea(double from, double to) {
        constexpr double sure = 0.8;  // of the area: κ may fall to 0 at one end
        const auto& [a, b, c, start] = powers_;
        const double c0 = 2 * cross(c, b), c1 = 6 * cross(c, a), c2 = -6 * cross(a, b);  // P' × P''
        const double per = 1 / (sure * area_chords::perArea * area_);
        return shares_.integrate(from, to, [=, this](Pair t) {
            const Pair x = xs_.slope(t), y = ys_.slope(t), square = x * x + y * y;
            const Pair turn = ((c2 * t + c1) * t + c0) / square,
                       speed = squareRoot(square) - distance_ * turn;
            const Pair chords = area_chords::density(per, turn, speed);
            return chords < maxDensity ? chords : 0.0;
        });
    }

    void byArea(double from, double to, int halvings) {
        const double whole = guessByArea(from, to);
        const bool isShort = whole <= 2 * area_chords::endShare;
        if (isShort && isNear(vertex(from), vertex((from + to) / 2), vertex(to)))
            return side_.addLine(vertex(to).at);
        const int count = area_chords::count(std::min(whole, double(maxChords)));
        if (count <= maxChords)
            findVertices(from, to, count, area_chords::endShare);
        if (halvings > 0 && (count > maxChords || !areNearByArea(count))) {
            const double middle = (from + to) / 2;
            byArea(from, middle, halvings - 1);
            byArea(middle, to, halvings - 1);
            return;
        }
        points_.resize(std::size_t(count) + 1);
        for (std::size_t i = 0; i < points_.size(); ++i)
            points_[i] = {x_[i], y_[i]};
        area_chords::moveOutwards(points_.size(), [&](std::size_t i) -> Point& { return points_[i]; });
        for (const Point p : std::span(points_).subspan(1))
            side_.addLine(p);
    }

    /// Whether the tangents in the middle of chords stray no farther than curves of that h³ κ do, by h² κ
    /// / 8.
    bool areNearByArea(int count) const {
        constexpr double slack = 1.25;  // the tangent strays a little farther
        const double maximum = slack * area_ * area_chords::perArea / 8;
        for (std::size_t k = 0; k < std::size_t(count); k += 2) {
            const double *const t = &t_[k], *const x = &x_[k], *const y = &y_[k];
            const Pair far = strayTimesLength(load(x), load(y), vertices(0.5 * (load(t) + load(t + 1))),
                                              load(x + 1), load(y + 1));
            if (!(far[0] <= maximum) || (k + 1 < std::size_t(count) && !(far[1] <= maximum)))
                return false;
        }
        return true;
    }

    void byDistance(double from, double to) {
        const double needed = guess(from, to);
        if (needed > maxChords) {
            const double middle = (from + to) / 2;
            byDistance(from, middle);
            byDistance(middle, to);
            return;
        }
        const int count = std::max(1, static_cast<int>(std::ceil(needed)));
        findVertices(from, to, count, 1);
        appendChords(count);
    }

    void findVertices(double from, double to, int count, double endShare) {
        const std::size_t last = std::size_t(count);
        t_[0] = from;
        shares_.cut(count, &t_[1], endShare);
        t_[last] = t_[last + 1] = to;
        for (std::size_t k = 0; k <= last; k += 2) {
            const Vertices two = vertices(load(&t_[k]));
            store(&x_[k], two.x), store(&y_[k], two.y);
        }
        const Point first = vertex(from).at, end = vertex(to).at;
        x_[0] = first.x, y_[0] = first.y;
        x_[last] = x_[last + 1] = end.x, y_[last] = y_[last + 1] = end.y;
    }

    void appendChords(int count) {
        int appended = 0;
        for (int k = 0; k < count; k += 2) {
            const double *const t = &t_[std::size_t(k)], *const x = &x_[std::size_t(k)],
                                *const y = &y_[std::size_t(k)];
            const PairMask near =
                areNear(load(x), load(y), vertices(0.5 * (load(t) + load(t + 1))), load(x + 1), load(y + 1));
            const int many = std::min(2, count - k);
            if (near[0] != 0 && (near[1] != 0 || many == 1))
                continue;
            side_.addLines(&x_[std::size_t(appended + 1)], &y_[std::size_t(appended + 1)], k - appended);
            for (int i = 0; i < many; ++i)
                chord(vertex(t[i]), vertex(t[i + 1]), maxChordHalvings);
            appended = k + many;
        }
        side_.addLines(&x_[std::size_t(appended + 1)], &y_[std::size_t(appended + 1)], count - appended);
    }

    void chord(const Vertex& a, const Vertex& b, int halvings) {
        const Vertex middle = vertex((a.t + b.t) / 2);
        if (halvings > 0 && !isNear(a, middle, b)) {
            chord(a, middle, halvings - 1);
            chord(middle, b, halvings - 1);
        } else {
            side_.addLine(b.at);
        }
    }

    bool isNear(const Vertex& a, const Vertex& m, const Vertex& b) const {
        const PairMask near = areNear(both(a.at.x), both(a.at.y),
                                      {both(m.at.x), both(m.at.y), both(m.along.x), both(m.along.y)},
                                      both(b.at.x), both(b.at.y));
        // So short that its direction is rounding.
        return near[0] != 0 || 2 * (glm::distance(a.at, m.at) + glm::distance(m.at, b.at)) <= tolerance_;
    }

    /// Whether the tangents in m stray less than the tolerance from the chords over their ends. False for
    /// infinite vertices.
    PairMask areNear(Pair ax, Pair ay, const Vertices& m, Pair bx, Pair by) const {
        const Pair x = bx - ax, y = by - ay;
        return strayTimesLength(ax, ay, m, bx, by) < tolerance_ * squareRoot(x * x + y * y);
    }
    /// How far they stray, times the chords' lengths.
    static Pair strayTimesLength(Pair ax, Pair ay, const Vertices& m, Pair bx, Pair by) {
        const Pair x = bx - ax, y = by - ay, mx = m.x - ax, my = m.y - ay;
        const Pair square = x * x + y * y, along = mx * x + my * y, rest = square - along;
        const Pair slope = magnitude((m.alongX * y - m.alongY * x) / (m.alongX * x + m.alongY * y));
        return magnitude(mx * y - my * x) + slope * (along > rest ? along : rest);
    }

    const Cubic& curve_;
    const PowerForm powers_;
    const Coordinate xs_, ys_;
    const double distance_, tolerance_, area_;
    Side& side_;
    EvenShares shares_;
    /// Vertices, and one more for loops over two at once.
    std::array<double, maxChords + 3> t_, x_, y_;
    std::vector<Point> points_;
};

// ---- What turns evenly ----------------------------------------------------------------------------------

/// Of what turns evenly: curves are better then, of which only what is near the picture is cut.
constexpr double tooMany = 256;

/// Steps by the same angle are chords enough where the radius of curvature is largest: as in an arc of that.
int chordCount(double turn, double radius, const ChordTolerance& tolerance) {
    const double length = radius * turn, sagitta = length * turn / 8;
    if (tolerance.area == 0)
        return int(std::max(1.0, std::min(tooMany, std::ceil(std::sqrt(sagitta / tolerance.distance)))));
    const double whole = area_chords::density(1 / (area_chords::perArea * tolerance.area), turn, length);
    if (whole <= 2 * area_chords::endShare && sagitta <= tolerance.distance)
        return 1;
    return area_chords::count(std::min(tooMany, whole));
}

/// A curve by a direction that turns by `angle`, in `count` steps.
struct Turning {
    Point start, end;
    Point direction;  ///< where it starts
    double angle;
    int count;
};

/// Goes on from its start; at(direction): a place of the curve.
template <class At>
void appendTurning(const Turning& curve, bool byArea, const At& at, Side& side) {
    const double endShare = byArea ? area_chords::endShare : 1;
    const double step = curve.angle / (curve.count - 2 + 2 * endShare);
    const Point turned{std::cos(step), std::sin(step)};
    const std::size_t before = side.ends.size();
    Point direction = curve.count > 1 ? rotate(curve.direction, step * endShare) : curve.direction;
    for (int i = 1; i < curve.count; ++i) {
        side.addLine(at(direction));
        direction = direction * turned.x + perp(direction) * turned.y;
    }
    side.addLine(curve.end);
    if (!byArea)
        return;
    Point start = curve.start;
    area_chords::moveOutwards(side.ends.size() - before + 1, [&](std::size_t i) -> Point& {
        return i == 0 ? start : side.ends[before + i - 1];
    });
}

}  // namespace

void appendChords(const Cubic& curve, double t0, double t1, double distance, ChordTolerance tolerance,
                  Side& side) {
    ChordOffset(curve, distance, tolerance, side).run(t0, t1);
}

bool appendChords(const Stretch& stretch, double distance, double radius, ChordTolerance tolerance,
                  Side& side) {
    const int count = chordCount(std::abs(stretch.turn()), radius, tolerance);
    if (count >= tooMany)
        return false;
    const Turning curve{stretch.offset(0, distance).at, stretch.offset(1, distance).at,
                        stretch.startTangent(), stretch.turn(), count};
    appendTurning(
        curve, tolerance.area > 0, [&](Point along) { return stretch.offsetWhere(along, distance); }, side);
    return true;
}

bool appendArcChords(Point center, Point from, double angle, ChordTolerance tolerance, Side& side) {
    const int count = chordCount(std::abs(angle), glm::length(from), tolerance);
    if (count >= tooMany)
        return false;
    const Turning curve{center + from, center + rotate(from, angle), from, angle, count};
    appendTurning(
        curve, tolerance.area > 0, [&](Point place) { return center + place; }, side);
    return true;
}

}  // namespace vtm::compiler::stroke

#include "compiler/lower/chords.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <vtm/limits/limits.hpp>
#include "scene/center_form.hpp"

namespace vtm::compiler {
namespace {

using geometry::EllipticalArc;
using scene::Affine;
using scene::Point;

/// Arcs are cut into cubics that turn by this much, if there is no tolerance.
constexpr double usualArcAngle = std::numbers::pi / 16;
/// Arcs so much finer are near the limit of double precision.
constexpr double finestArcAngle = usualArcAngle / 64;

/// Walks the commands with the current point in path space.
class Walker {
public:
    Walker(CurveSink& sink, const Affine& m, double arcTolerance)
        : sink_(sink), m_(m), arcTolerance_(arcTolerance) {}

    void operator()(const scene::MoveTo& c) {
        close();
        begin(c.to);
    }
    void operator()(const scene::LineTo& c) {
        sink_.line(map(c.to));
        current_ = c.to;
    }
    void operator()(const scene::QuadTo& c) {
        const Point p0 = map(current_), q = map(c.control), p3 = map(c.to);
        sink_.cubic(geometry::raised(p0, q, p3));
        current_ = c.to;
    }
    void operator()(const scene::CubicTo& c) {
        sink_.cubic({map(current_), map(c.control1), map(c.control2), map(c.to)});
        current_ = c.to;
    }
    void operator()(const scene::ArcTo& c) {
        arc(c);
        current_ = c.to;
    }
    void operator()(const scene::Close&) {
        close();
        begin(start_);
    }
    void close() {
        if (started_)
            sink_.line(map(start_));
    }

private:
    Point map(Point p) const { return m_[0] * p.x + m_[1] * p.y + m_[2]; }

    void begin(Point p) {
        start_ = current_ = p;
        started_ = true;
        sink_.start(map(p));
    }

    double partAngle(const EllipticalArc& mappedArc) const {
        if (std::isinf(arcTolerance_))
            return usualArcAngle;
        const double radius = std::sqrt(glm::dot(mappedArc.axisX, mappedArc.axisX) +
                                        glm::dot(mappedArc.axisY, mappedArc.axisY));
        return std::max(finestArcAngle, geometry::cubicArcAngle(radius, arcTolerance_));
    }

    void arc(const scene::ArcTo& c) {
        if (current_ == c.to)
            return;
        const auto arc = scene::centerForm(current_, c);
        if (!arc)
            return sink_.line(map(c.to));
        const EllipticalArc mapped = geometry::mapped(*arc, m_);
        std::vector<Cubic> parts = geometry::cubics(mapped, geometry::cubicCount(mapped, partAngle(mapped)));
        parts.front().p0 = map(current_);
        parts.back().p3 = map(c.to);
        for (const Cubic& part : parts)
            sink_.cubic(part);
    }

    CurveSink& sink_;
    const Affine m_;
    const double arcTolerance_;
    Point start_{}, current_{};
    bool started_ = false;
};

}  // namespace

scene::Affine withoutFarAway(scene::Affine m) {
    for (int c = 0; c < 3; ++c)
        m[c] = glm::dvec2{std::clamp(m[c].x, -farAway, farAway), std::clamp(m[c].y, -farAway, farAway)};
    return m;
}

void walkCurves(const scene::Path& path, const Affine& map, CurveSink& sink, double arcTolerance) {
    Walker walker(sink, withoutFarAway(map), arcTolerance);
    for (const scene::Command& command : path) {
        limits::check();
        std::visit(walker, command);
    }
    walker.close();
}

namespace {

/// Brings any chord of a curve that may be cut below its tolerance.
constexpr int maxHalvings = 40;

double cross(scene::Point a, scene::Point b) { return a.x * b.y - a.y * b.x; }
double dot(scene::Point a, scene::Point b) { return a.x * b.x + a.y * b.y; }

}  // namespace

/// How far the curve's accelerations lead across its chord d over a step h: with p and q at the ends,
/// h² (|d × p| + |d × q|) / 2. Of one chord or of two at once.
struct ChordCutter::Across {
    double ax, ay, bx, by;

    explicit Across(const Curve& curve)
        : ax(3 * curve.a.x), ay(3 * curve.a.y), bx(curve.b.x), by(curve.b.y) {}

    template <class Number>
    Number operator()(const Vertex<Number>& from, const Vertex<Number>& to) const {
        const Number h = to.t - from.t, dx = to.x - from.x, dy = to.y - from.y;
        const Number a = dx * ay - dy * ax, b = dx * by - dy * bx;  // d × P'' / 2 = a t + b
        return h * h * (magnitude(a * from.t + b) + magnitude(a * to.t + b));
    }
};

/// Whether across its chord d over a step h the curve strays no farther than the tolerance. With the
/// accelerations p and q at the ends it strays by f(s) = h² s (1 - s) (d × p (2 - s) + d × q (1 + s)) / (6
/// |d|), so by h² (|d × p| + |d × q|) / (9 √3 |d|) at most.
struct ChordCutter::Proof {
    Across across;
    double maximum;

    Proof(const Curve& curve, double tolerance) : across(curve), maximum(60.75 * tolerance * tolerance) {}

    /// A truth value for each number.
    template <class Number>
    auto operator()(const Vertex<Number>& from, const Vertex<Number>& to) const {
        const Number far = across(from, to), dx = to.x - from.x, dy = to.y - from.y;
        return far * far <= maximum * (dx * dx + dy * dy);
    }
};

std::span<const scene::Point> ChordCutter::cut(const Cubic& p) {
    curve_ = {p.p3 - p.p0 + 3.0 * (p.p1 - p.p2), 3.0 * (p.p0 - 2.0 * p.p1 + p.p2), 3.0 * (p.p1 - p.p0), p.p0};
    if (area_ > 0)
        return cutByArea(p.p3);
    const double needed = guess();
    if (!(needed <= maxChords) || !isResolved())
        return {};
    const int whole = static_cast<int>(needed), count = std::max(1, whole + (whole < needed));
    findVertices(count, p.p3, 1);
    runForward_ = runForward(0, count);
    appendChords(count);
    return ends_;
}

std::span<const scene::Point> ChordCutter::cutByArea(Point end) {
    const double whole = guessByArea();
    if (!(whole <= maxChords - 2) || !isResolved())
        return {};
    const int count = area_chords::count(whole);
    findVertices(count, end, area_chords::endShare);
    if (!runForward(0, count) || !areNearByArea(count))
        return {};
    ends_.assign({curve_.start});
    appendVertices(1, count);
    area_chords::moveOutwards(ends_.size(), [&](std::size_t i) -> Point& { return ends_[i]; });
    return std::span(ends_).subspan(1);
}

/// The number of whole chords.
double ChordCutter::guessByArea() {
    constexpr double sure = 0.9;         // of the area: steps are not small
    constexpr double perInflection = 2;  // where κ changes its sign, chords next to each other differ more
    const auto [a, b, c, start] = curve_;
    const double c0 = 2 * cross(c, b), c1 = 6 * cross(c, a), c2 = -6 * cross(a, b);  // P' × P''
    const double turns = c0 * (c0 + c1 + c2) < 0 ? perInflection : 1;
    const double per = turns / (sure * area_chords::perArea * area_), perTurn = perTurn_;
    constexpr double minSquare = std::numeric_limits<double>::min();  // no division by zero
    return shares_.integrate(0, 1, [=](Pair t) {
        const Pair x = (3 * a.x * t + 2 * b.x) * t + c.x, y = (3 * a.y * t + 2 * b.y) * t + c.y;
        const Pair square = x * x + y * y + minSquare;
        return area_chords::density(per, ((c2 * t + c1) * t + c0) / square, squareRoot(square), perTurn);
    });
}

/// Whether h³ κ, about h² |d × P''|, is no more than it may be for any chord.
bool ChordCutter::areNearByArea(int count) const {
    const Across across(curve_);
    const double maximum = area_ * area_chords::perArea;
    PairMask near{-1, -1};
    for (std::size_t k = 0; k < std::size_t(count); k += 2)
        near &= across(Vertex<Pair>{load(&t_[k]), load(&x_[k]), load(&y_[k])},
                       Vertex<Pair>{load(&t_[k + 1]), load(&x_[k + 1]), load(&y_[k + 1])}) <= maximum;
    return (near[0] & near[1]) != 0;
}

/// Whether points of the curve are rounded by less than the tolerance. Beyond, chords between them are noise,
/// which no number of halvings proves.
bool ChordCutter::isResolved() const {
    constexpr double rounding = 0x1p-50;  // of the largest of four terms, twice at most in each of three sums
    double largest = 0;
    for (const Point p : {curve_.a, curve_.b, curve_.c, curve_.start})
        largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    return rounding * largest <= tolerance_;
}

/// The number of chords that will do if each of them has an equal share of it.
double ChordCutter::guess() {
    constexpr double sure = 0.9;                                     // of the tolerance: steps are not small
    constexpr double minSpeed = std::numeric_limits<double>::min();  // no division by zero
    const auto [a, b, c, start] = curve_;
    const double c0 = 2 * cross(c, b), c1 = 6 * cross(c, a), c2 = -6 * cross(a, b);  // P' × P''
    const double ax = 3 * a.x, ay = 3 * a.y, bx = 2 * b.x, by = 2 * b.y, cx = c.x, cy = c.y;
    const double per = 1 / (8 * sure * tolerance_);
    return shares_.integrate(0, 1, [=](Pair t) {
        const Pair x = (t * ax + bx) * t + cx, y = (t * ay + by) * t + cy;
        const Pair speed = squareRoot(x * x + y * y) + minSpeed;
        return squareRoot(per * magnitude((c2 * t + c1) * t + c0) / speed);
    });
}

void ChordCutter::findVertices(int count, Point end, double endShare) {
    const auto [a, b, c, start] = curve_;
    t_[0] = 0;
    shares_.cut(count, &t_[1], endShare);
    t_[std::size_t(count)] = t_[std::size_t(count) + 1] = 1;
    for (std::size_t k = 0; k < std::size_t(count); k += 2) {
        const Pair t = load(&t_[k]);
        store(&x_[k], ((a.x * t + b.x) * t + c.x) * t + start.x);
        store(&y_[k], ((a.y * t + b.y) * t + c.y) * t + start.y);
    }
    for (const std::size_t k : {std::size_t(count), std::size_t(count) + 1})
        x_[k] = end.x, y_[k] = end.y;
}

/// Whether no two velocities between point away from each other, so that along a chord the curve runs from
/// one end to the other without turning back: so if it is the case for the velocity's Bernstein coefficients.
bool ChordCutter::runsForward(double t0, double t1) const {
    const Point v = curve_.velocity(t0), w = curve_.velocity(t1),
                m = v + (3.0 * curve_.a * t0 + curve_.b) * (t1 - t0);
    return (dot(v, m) >= 0) & (dot(m, w) >= 0) & (dot(v, w) >= 0);
}

/// All chords between two vertices.
bool ChordCutter::runForward(int first, int last) const {
    if (runsForward(t_[std::size_t(first)], t_[std::size_t(last)]))
        return true;
    const int middle = (first + last) / 2;
    return middle > first && runForward(first, middle) && runForward(middle, last);
}

void ChordCutter::appendChords(int count) {
    const Proof isNear(curve_, tolerance_);
    int appended = 0;
    ends_.clear();
    for (int k = 0; k < count; k += 2) {
        const double *const t = &t_[std::size_t(k)], *const x = &x_[std::size_t(k)],
                            *const y = &y_[std::size_t(k)];
        const PairMask near = isNear(Vertex<Pair>{load(t), load(x), load(y)},
                                     Vertex<Pair>{load(t + 1), load(x + 1), load(y + 1)});
        if ((near[0] & near[1]) != 0 && runForward_)
            continue;
        appendVertices(appended + 1, k);
        for (int i = 0; i < std::min(2, count - k); ++i) {
            const Vertex<double> from{t[i], x[i], y[i]}, to{t[i + 1], x[i + 1], y[i + 1]};
            if (near[i] != 0 && (runForward_ || runsForward(from.t, to.t)))
                ends_.push_back({to.x, to.y});
            else
                halves(from, to, maxHalvings);
        }
        appended = k + 2;
    }
    appendVertices(appended + 1, count);
}

/// From the first to the last one.
void ChordCutter::appendVertices(int first, int last) {
    const std::size_t before = ends_.size(), count = std::size_t(std::max(0, last + 1 - first));
    ends_.resize(before + count);
    Point* const ends = ends_.data() + before;
    const double *const x = x_.data() + first, *const y = y_.data() + first;
    for (std::size_t k = 0; k < count; ++k)
        ends[k] = {x[k], y[k]};
}

void ChordCutter::chord(const Vertex<double>& from, const Vertex<double>& to, int halvings) {
    const bool isProven = Proof(curve_, tolerance_)(from, to) && (runForward_ || runsForward(from.t, to.t));
    if (halvings > 0 && !isProven)
        halves(from, to, halvings);
    else
        ends_.push_back({to.x, to.y});
}

void ChordCutter::halves(const Vertex<double>& from, const Vertex<double>& to, int halvings) {
    const double t = (from.t + to.t) / 2;
    const Point at = curve_.at(t);
    chord(from, {t, at.x, at.y}, halvings - 1);
    chord({t, at.x, at.y}, to, halvings - 1);
}

}  // namespace vtm::compiler

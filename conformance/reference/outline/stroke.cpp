#include "conformance/reference/outline/stroke.hpp"

#include <numbers>
#include <optional>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/outline/stroke_line.hpp"

namespace vtm::reference {
namespace {

/// A circle has at most 2·pi / minTurn chords. It binds beyond a radius of 8e4 pixels at a flatness of
/// 1e-4; the error there is radius · minTurn² / 8.
constexpr double minTurn = 1e-4;
constexpr double maxTurn = std::numbers::pi / 16;
/// Half widths beyond it (pixels) are cut down to it. Doubles place the ends of such long segments
/// across the line to 1e-9 pixels; much beyond, rounding alone would scatter edges all over the view.
constexpr double widestHalf = 1e7;
/// A mitre at its limit up to rounding is kept.
constexpr double miterSlack = 1e-9;
/// Curves out of view keep their length to about this share squared, for the dashes after them; where there
/// are none, each becomes its chord.
constexpr double hiddenTolerance = 1e-5;

/// The turn between two radii whose chord lies within `tolerance` of the circle:
/// radius·(1 - cos(turn / 2)) = tolerance.
double turnWithin(double tolerance, double radius) {
    return std::clamp(2 * std::acos(std::max(0.0, 1 - tolerance / radius)), minTurn, maxTurn);
}

Vector rotated(Vector v, double angle) { return std::cos(angle) * v + std::sin(angle) * normalOf(v); }

/// Where the segments ab and cd cross inside both.
std::optional<Point> crossing(Point a, Point b, Point c, Point d) {
    const double whole = cross(b - a, d - c);
    const double s = cross(c - a, d - c) / whole, t = cross(c - a, b - a) / whole;
    if (!(s > 0 && s < 1 && t > 0 && t < 1))
        return std::nullopt;
    return a + s * (b - a);
}

double doubleArea(std::span<const Point> p) {
    double sum = 0;
    for (std::size_t i = 2; i < p.size(); ++i)
        sum += cross(p[i - 1] - p[0], p[i] - p[0]);
    return sum;
}

class Stroker {
public:
    Stroker(const scene::StrokeStyle& style, const Affine& toPixels, const View& view, double flatness,
            int shape, EdgeList& edges)
        : style_(style),
          half_(std::min(style.width / 2, widestHalf / largestScale(toPixels))),
          toPixels_(toPixels),
          view_(boxOf(view)),
          reach_(half_ * largestScale(toPixels)),
          turn_(turnWithin(flatness, reach_)),
          shape_(shape),
          edges_(edges) {}

    Fineness fineness(double flatness) const {
        const bool mitred = style_.join == scene::Join::Miter || style_.join == scene::Join::MiterClip;
        const double farthest = std::max(std::numbers::sqrt2, mitred ? style_.miterLimit : 1.0);
        return {toPixels_, view_.grownBy(reach_ * farthest + 1), flatness, turn_,
                style_.dashes.empty() ? wholePiece : hiddenTolerance};
    }

    void stroke(const StrokeLine& line) {
        const std::vector<Run>& runs = line.runs;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            body(runs[i]);
            if (i + 1 < runs.size())
                join(runs[i].back(), runs[i + 1].front());
        }
        if (line.closed) {
            join(runs.back().back(), runs.front().front());
        } else {
            cap(runs.front().front().at, -runs.front().front().direction);
            cap(runs.back().back().at, runs.back().back().direction);
        }
    }

private:
    /// Edges along the line across a sample, from the steps before and after it. They overlap; what is
    /// left of their sum has the same ends, is as closed, and mostly nothing.
    class AcrossLine {
    public:
        /// `across`: the line's direction.
        void add(Point from, Point to, Vector across, bool forward) {
            ends_.push_back({dot(from, across), from, forward ? -1 : 1});
            ends_.push_back({dot(to, across), to, forward ? 1 : -1});
        }
        /// Between neighbouring ends runs what the ends so far have begun and not ended.
        void flush(Stroker& stroker) {
            std::stable_sort(ends_.begin(), ends_.end(),
                             [](const End& a, const End& b) { return a.place < b.place; });
            int running = 0;
            for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
                running -= ends_[i].balance;
                for (int n = 0; n < std::abs(running); ++n)
                    stroker.edge(ends_[i].at, ends_[i + 1].at, running > 0);
            }
            ends_.clear();
        }

    private:
        struct End {
            double place;
            Point at;
            int balance;  ///< edges that end here minus those that begin
        };
        std::vector<End> ends_;
    };

    // Pieces of a stroke, in path space.

    void body(const Run& run) {
        for (std::size_t i = 0; i + 1 < run.size(); ++i) {
            Sample a = run[i];
            const Sample& b = run[i + 1];
            if (angleBetween(a.direction, b.direction) >
                2 * turn_) {  // a cusp: the segment turns on the spot
                across_.flush(*this);
                spin(a.at, a.direction, b.direction);
                a.direction = b.direction;
            }
            step(a, b);
        }
        across_.flush(*this);
    }

    /// What the segment across the line sweeps while it turns about its middle.
    void spin(Point at, Vector from, Vector to) {
        const double angle = std::atan2(cross(from, to), dot(from, to));
        fan(at, half_ * normalOf(from), angle);
        fan(at, -half_ * normalOf(from), angle);
    }

    /// What the segment across the line sweeps between two samples.
    void step(const Sample& a, const Sample& b) {
        const Vector na = half_ * normalOf(a.direction), nb = half_ * normalOf(b.direction);
        if (!meetsView(std::array{a.at - na, b.at - nb, b.at + nb, a.at + na})) {
            across_.flush(*this);
            return;
        }
        AcrossLine next;
        sweepSide(a.at, b.at, na, nb, 1, next);
        sweepSide(a.at, b.at, na, nb, -1, next);
        across_.flush(*this);
        across_ = std::move(next);
    }

    /// One half of the segment, to the side that `sign` says: a quadrilateral. Where its outer end moves
    /// backwards, since the line turns tighter than the stroke is wide, it crosses itself and is two
    /// triangles. The chord from a to b, which both halves share, cancels.
    void sweepSide(Point a, Point b, Vector na, Vector nb, double sign, AcrossLine& next) {
        const Point p = a + sign * na, q = b + sign * nb;
        const auto turned = crossing(a, p, b, q);
        const bool forward = sign > 0;
        if (!turned) {
            next.add(b, q, nb, forward);
            edge(q, p, forward);
            across_.add(p, a, na, forward);
            return;
        }
        next.add(b, *turned, nb, forward);
        across_.add(*turned, a, na, forward);
        across_.add(*turned, p, na, forward);
        edge(p, q, forward);
        next.add(q, *turned, nb, forward);
    }

    void join(const Sample& before, const Sample& after) {
        const Vector d0 = before.direction, d1 = after.direction;
        const Point p = before.at;
        const double turn = cross(d0, d1);
        if (turn == 0 && dot(d0, d1) > 0)
            return;
        const double outside = turn >= 0 ? -half_ : half_;
        const Vector a = outside * normalOf(d0), b = outside * normalOf(d1);
        // Of a sum that rounding of the directions moves by 1e-16; 1 + cosine would lose half its digits.
        const double halfAngleSine = length(d0 + d1) / 2;
        const bool sharp = style_.miterLimit * halfAngleSine * (1 + miterSlack) < 1;
        if (style_.join == scene::Join::Round)
            fan(p, a, turn >= 0 ? angleBetween(d0, d1) : -angleBetween(d0, d1));
        else if (style_.join == scene::Join::Bevel || (style_.join == scene::Join::Miter && sharp))
            polygon({{p, p + a, p + b}});
        else if (sharp)
            clippedMiter(p, a, b, d0, d1);
        else
            polygon({{p, p + a, p + (a + b) / (2 * halfAngleSine * halfAngleSine), p + b}});
    }

    /// SVG 2 section 13.5.4: cut across at miterLimit · width / 2 from the corner.
    void clippedMiter(Point p, Vector a, Vector b, Vector d0, Vector d1) {
        // Along a + b, of which nothing but rounding is left where the line turns back.
        const Vector out = (d0 - d1) / length(d0 - d1);
        const double further = (style_.miterLimit * half_ - dot(a, out)) / dot(d0, out);
        polygon({{p, p + a, p + a + further * d0, p + b - further * d1, p + b}});
    }

    void cap(Point p, Vector outward) {
        const Vector n = half_ * normalOf(outward), out = half_ * outward;
        if (style_.cap == scene::Cap::Round)
            fan(p, -n, std::numbers::pi);
        else if (style_.cap == scene::Cap::Square)
            polygon({{p - n, p - n + out, p + n + out, p + n}});
    }

    // Their outlines.

    /// A sector of the disc around p from the radius `from` on, signed angle.
    void fan(Point p, Vector from, double angle) {
        const Point center = scene::apply(toPixels_, p);
        if (!Box{center, center}.grownBy(reach_).meets(view_))
            return;
        const int steps = std::max(1, int(std::ceil(std::abs(angle) / turn_)));
        points_ = {p};
        for (int i = 0; i <= steps; ++i)
            points_.push_back(p + rotated(from, angle * i / steps));
        polygon(points_);
    }

    void polygon(std::initializer_list<Point> points) { polygon(std::span(points.begin(), points.size())); }

    void polygon(std::span<const Point> points) {
        if (!meetsView(points))
            return;
        const bool forward = doubleArea(points) > 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point p = points[i], q = points[(i + 1) % points.size()];
            edge(p, q, forward);
        }
    }

    bool meetsView(std::span<const Point> points) {
        mapped_.clear();
        for (const Point p : points)
            mapped_.push_back(scene::apply(toPixels_, p));
        return Box::around(mapped_).meets(view_);
    }

    void edge(Point from, Point to, bool forward = true) {
        const Point p = scene::apply(toPixels_, from), q = scene::apply(toPixels_, to);
        edges_.add(forward ? p : q, forward ? q : p, shape_);
    }

    const scene::StrokeStyle& style_;
    double half_;
    Affine toPixels_;
    Box view_;
    double reach_;  ///< half the width in pixels, where it is largest
    double turn_;   ///< greatest turn between neighbouring radii of a fan
    int shape_;
    EdgeList& edges_;
    AcrossLine across_;  ///< at the sample between two steps
    std::vector<Point> points_, mapped_;
};

}  // namespace

void addStroke(const scene::Path& path, const scene::StrokeStyle& style, const Affine& toPixels,
               const View& view, double flatness, int shape, EdgeList& edges) {
    Stroker stroker(style, toPixels, view, flatness, shape, edges);
    const Fineness fineness = stroker.fineness(flatness);
    std::vector<StrokeLine> lines = strokeLinesOf(path, fineness);
    if (!style.dashes.empty())
        if (auto dashes = dash(lines, style, fineness))
            lines = std::move(*dashes);
    for (const StrokeLine& line : lines) {
        limits::check();
        stroker.stroke(line);
    }
}

}  // namespace vtm::reference

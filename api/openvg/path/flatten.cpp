#include "api/openvg/path/flatten.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <variant>

#include <glm/geometric.hpp>

#include "api/openvg/path/segment.hpp"

namespace vtm::openvg {

namespace {

using glm::dvec2;

constexpr double flatness = 1.0 / 64;
/// Of one segment; what is larger than any surface need not be rounder than this.
constexpr double mostLines = 4096;

bool isBefore(dvec2 a, dvec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }

int linesFor(double bend) {
    // max first: it makes 1 of what is no number.
    return int(std::min(std::max(1.0, std::ceil(std::sqrt(bend / (8 * flatness)))), mostLines));
}

template <std::size_t N>
dvec2 bezier(std::array<dvec2, N> p, double t) {
    for (std::size_t n = N - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i)
            p[i] += t * (p[i + 1] - p[i]);
    return p[0];
}

class Flattener {
public:
    Flattener(const glm::mat3& map, const std::function<void(dvec2, dvec2)>& line) : map_(map), line_(line) {}

    void moveTo(dvec2 p) {
        close();
        start_ = at_ = p;
    }
    void close() { lineTo(start_); }
    dvec2 at() const { return at_; }
    void lineTo(dvec2 p) {
        emit(mapped(at_), mapped(p));
        at_ = p;
    }
    template <std::size_t N>
    void curveTo(std::array<dvec2, N> p) {
        at_ = p[N - 1];
        for (dvec2& q : p)
            q = mapped(q);
        const bool backwards = isBefore(p[N - 1], p[0]);
        if (backwards)
            std::ranges::reverse(p);
        // |B''| is at most n (n - 1) times the largest second difference.
        double bend = 0;
        for (std::size_t i = 0; i + 2 < N; ++i)
            bend = std::max(bend, glm::length(p[i] - 2.0 * p[i + 1] + p[i + 2]));
        emitAll(linesFor(double((N - 1) * (N - 2)) * bend), backwards, p[0], p[N - 1],
                [&](double t) { return bezier(p, t); });
    }
    void arcTo(const scene::ArcTo& arc) {
        Segment segment = arcSegment(at_, arc);
        // From the lesser end, so that both directions see one ellipse.
        const bool backwards = isBefore(segment.to, segment.from);
        if (backwards) {
            std::swap(segment.from, segment.to);
            segment.type = segment.type == VG_SCCWARC_TO   ? VG_SCWARC_TO
                           : segment.type == VG_SCWARC_TO  ? VG_SCCWARC_TO
                           : segment.type == VG_LCCWARC_TO ? VG_LCWARC_TO
                                                           : VG_LCCWARC_TO;
        }
        EllipticalArc ellipse;
        if (!arcOf(segment, ellipse))
            return lineTo(arc.to);
        at_ = arc.to;
        const glm::dmat3 m(map_);
        const double radius = std::hypot(glm::length(dvec2(m * glm::dvec3(ellipse.axisX, 0))),
                                         glm::length(dvec2(m * glm::dvec3(ellipse.axisY, 0))));
        emitAll(linesFor(radius * ellipse.sweep * ellipse.sweep), backwards, mapped(segment.from),
                mapped(segment.to),
                [&](double t) { return mapped(ellipse.at(ellipse.start + t * ellipse.sweep)); });
    }

private:
    dvec2 mapped(dvec2 p) const { return dvec2(glm::dmat3(map_) * glm::dvec3(p, 1)); }
    void emit(dvec2 a, dvec2 b) const {
        if (a != b)
            line_(a, b);
    }
    template <class Curve>
    void emitAll(int count, bool backwards, dvec2 first, dvec2 last, Curve&& curve) const {
        dvec2 a = first;
        for (int i = 1; i <= count; ++i) {
            const dvec2 b = i == count ? last : curve(double(i) / count);
            backwards ? emit(b, a) : emit(a, b);
            a = b;
        }
    }

    const glm::mat3& map_;
    const std::function<void(dvec2, dvec2)>& line_;
    dvec2 start_{0}, at_{0};
};

}  // namespace

void flatten(const scene::Path& outline, const glm::mat3& map,
             const std::function<void(dvec2, dvec2)>& line) {
    Flattener f(map, line);
    dvec2 at(0);
    for (const scene::Command& command : outline) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command))
            f.moveTo(move->to);
        else if (const auto* to = std::get_if<scene::LineTo>(&command))
            f.lineTo(to->to);
        else if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            f.curveTo(std::array{at, quad->control, quad->to});
        else if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            f.curveTo(std::array{at, cubic->control1, cubic->control2, cubic->to});
        else if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            f.arcTo(*arc);
        else
            f.close();
        at = f.at();
    }
    f.close();
}

Box boxOf(const scene::Path& outline) {
    Box box;
    bool isFirst = true;
    const auto take = [&](dvec2 p) {
        box.min = isFirst ? p : glm::min(box.min, p);
        box.max = isFirst ? p : glm::max(box.max, p);
        isFirst = false;
    };
    dvec2 at(0);
    for (const scene::Command& command : outline) {
        if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            take(quad->control);
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            take(cubic->control1);
            take(cubic->control2);
        } else if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            EllipticalArc ellipse;
            if (arcOf(arcSegment(at, *arc), ellipse)) {
                const dvec2 reach(std::hypot(ellipse.axisX.x, ellipse.axisY.x),
                                  std::hypot(ellipse.axisX.y, ellipse.axisY.y));
                take(ellipse.center - reach);
                take(ellipse.center + reach);
            }
        }
        if (const auto end = scene::endOf(command)) {
            at = *end;
            take(at);
        }
    }
    return box;
}

}  // namespace vtm::openvg

#include "api/openvg/path/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <variant>

#include <glm/geometric.hpp>

#include "scene/center_form.hpp"

namespace vtm::openvg {

namespace {

using glm::dvec2;

constexpr double flatness = 1.0 / 64;
/// Of one segment; what is larger than any surface need not be rounder than this.
constexpr double maxLines = 4096;

bool isBefore(dvec2 a, dvec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }

/// For a curve that strays so far from its chord: n lines stray a share of 1 / n² as far.
int linesFor(double chordError) {
    // max first: it makes 1 of NaN.
    return int(std::min(std::max(1.0, std::ceil(std::sqrt(chordError / flatness))), maxLines));
}

class Flattener {
public:
    Flattener(const glm::mat3& map, const std::function<void(dvec2, dvec2)>& line) : map_(map), line_(line) {}

    void moveTo(dvec2 p) {
        close();
        start_ = at_ = p;
    }
    void close() { lineTo(start_); }
    void lineTo(dvec2 p) {
        emit(mapped(at_), mapped(p));
        at_ = p;
    }
    void curveTo(dvec2 control1, dvec2 control2, dvec2 to) {
        geometry::Cubic c{mapped(at_), mapped(control1), mapped(control2), mapped(to)};
        at_ = to;
        const bool backwards = isBefore(c.p3, c.p0);
        if (backwards)
            c = {c.p3, c.p2, c.p1, c.p0};
        emitAll(linesFor(geometry::chordError(c)), backwards, c.p0, c.p3, [&](double t) { return c.at(t); });
    }
    void quadTo(dvec2 control, dvec2 to) {
        const geometry::Cubic c = geometry::raised(at_, control, to);
        curveTo(c.p1, c.p2, to);
    }
    void arcTo(scene::ArcTo arc) {
        dvec2 from = at_;
        at_ = arc.to;
        // From the lesser end, so that both directions see one ellipse.
        const bool backwards = isBefore(arc.to, from);
        if (backwards) {
            std::swap(from, arc.to);
            arc.sweep = !arc.sweep;
        }
        const auto center = scene::centerForm(from, arc);
        if (!center)
            return emitAll(1, backwards, mapped(from), mapped(arc.to), [](double) { return dvec2(0); });
        const geometry::EllipticalArc ellipse = geometry::mapped(*center, glm::dmat3x2(map_));
        // |p''| / 8, over the whole sweep.
        const double radius = std::hypot(glm::length(ellipse.axisX), glm::length(ellipse.axisY));
        emitAll(linesFor(radius * ellipse.sweep * ellipse.sweep / 8), backwards, mapped(from), mapped(arc.to),
                [&](double t) { return ellipse.at(ellipse.start + t * ellipse.sweep); });
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
    for (const scene::Command& command : outline) {
        if (const auto* move = std::get_if<scene::MoveTo>(&command))
            f.moveTo(move->to);
        else if (const auto* to = std::get_if<scene::LineTo>(&command))
            f.lineTo(to->to);
        else if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            f.quadTo(quad->control, quad->to);
        else if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            f.curveTo(cubic->control1, cubic->control2, cubic->to);
        else if (const auto* arc = std::get_if<scene::ArcTo>(&command))
            f.arcTo(*arc);
        else
            f.close();
    }
    f.close();
}

geometry::Box boxOf(const scene::Path& outline) {
    geometry::Box box;
    dvec2 at(0);
    for (const scene::Command& command : outline) {
        if (const auto* quad = std::get_if<scene::QuadTo>(&command)) {
            box.add(quad->control);
        } else if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            box.add(cubic->control1);
            box.add(cubic->control2);
        } else if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            if (const auto ellipse = scene::centerForm(at, *arc))
                box.add(geometry::bounds(*ellipse));
        }
        if (const auto end = scene::endOf(command)) {
            at = *end;
            box.add(at);
        }
    }
    return box;
}

}  // namespace vtm::openvg

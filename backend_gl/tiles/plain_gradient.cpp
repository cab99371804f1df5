#include "backend_gl/tiles/plain_gradient.hpp"

#include <glm/geometric.hpp>

namespace vtm::gl::plain {

using asset::Gradient;
using asset::GradientStop;
using asset::Spread;
using asset::Texel;
using glm::dvec2;
using glm::dvec4;

Ramp::Ramp(std::span<const Texel> data, std::uint32_t texel, const Gradient& gradient)
    : spread_(gradient.spread) {
    for (std::uint32_t i = 0; i < gradient.stopCount; ++i) {
        const auto stop =
            asset::recordAt<GradientStop>(data, texel + std::uint32_t(asset::GradientView::headTexels) + i);
        offsets_.push_back(double(stop.offset));
        colors_.push_back(dvec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0);
    }
}

dvec4 Ramp::at(double u) const {
    const dvec4 c = straight(spread_ == Spread::Reflect  ? 1 - std::abs(1 - (u - 2 * std::floor(u / 2)))
                             : spread_ == Spread::Repeat ? u - std::floor(u)
                                                         : u);
    return {c.a * c.r, c.a * c.g, c.a * c.b, c.a};
}

std::optional<std::vector<double>> Ramp::corners(double from, double to) const {
    std::vector<double> found;
    const double first = spread_ == Spread::Pad ? 0 : std::floor(from),
                 last = spread_ == Spread::Pad ? 0 : std::floor(to);
    if (!((last - first + 1) * double(offsets_.size()) <= maxPlainStops))
        return std::nullopt;
    const auto add = [&](double u) {
        if (u >= from && u <= to)
            found.push_back(u);
    };
    for (double period = first; period <= last; ++period) {
        const bool isBackwards = spread_ == Spread::Reflect && std::fmod(period, 2) != 0;
        for (const double offset : offsets_)
            add(period + (isBackwards ? 1 - offset : offset));
        if (spread_ != Spread::Pad)
            add(period);
    }
    return found;
}

bool Ramp::isOpaque() const {
    return std::ranges::all_of(colors_, [](const dvec4& c) { return c.a == 1; });
}

dvec4 Ramp::straight(double u) const {
    const auto next = std::size_t(std::ranges::upper_bound(offsets_, u) - offsets_.begin());
    if (next == 0 || next == offsets_.size())
        return next == 0 ? colors_.front() : colors_.back();
    const double from = offsets_[next - 1];
    return glm::mix(colors_[next - 1], colors_[next], (u - from) / (offsets_[next] - from));
}

// ---- Place ----------------------------------------------------------------------------------------

namespace {

double valueOf(const std::array<double, 3>& row, dvec2 p) { return row[0] * p.x + row[1] * p.y + row[2]; }

Interval intervalOf(const std::array<double, 3>& row, double margin) {
    const double middle = valueOf(row, dvec2(0.5)),
                 reach = 0.5 * (std::abs(row[0]) + std::abs(row[1])) + margin * std::hypot(row[0], row[1]);
    return {middle - reach, middle + reach};
}

/// Where the circles of a radial gradient lie within each other by this much; as in steepness.cpp.
constexpr double minCircleGap = 0.1;

}  // namespace

double Place::at(dvec2 p) const {
    const double along = valueOf(x, p);
    return isRadial ? std::hypot(along, valueOf(y, p)) + e * along : along;
}

Interval Place::over(double margin) const {
    const Interval along = intervalOf(x, margin);
    if (!isRadial)
        return along;
    const Interval across = intervalOf(y, margin);
    const double middle = at(dvec2(0.5)), reach = slope() * (std::sqrt(0.5) + margin);
    return {std::max(std::hypot(along.least(), across.least()) + e * along.from, middle - reach),
            std::min(std::hypot(along.most(), across.most()) + e * along.to, middle + reach)};
}

double Place::stretch() const {
    if (!isRadial)
        return std::hypot(x[0], x[1]);
    const double sum = x[0] * x[0] + x[1] * x[1] + y[0] * y[0] + y[1] * y[1];
    return std::sqrt(0.5 * sum + std::sqrt(std::max(0.25 * sum * sum - area() * area(), 0.0)));
}

bool Place::isFinite() const {
    const auto finite = [](double v) { return std::isfinite(float(v)); };
    return std::ranges::all_of(x, finite) && std::ranges::all_of(y, finite) && finite(e);
}

/// With d = p - f, f along the x axis, the offset is u = b + sqrt(b² + c), b = (dx |f| - fr (1-fr)) / a,
/// c = (|d|² - fr²) / a, a = (1-fr)² - |f|² (gradient.cpp). Under the root stands a sum of two squares:
///     q = (((1-fr) dx - |f| fr) / a, dy / sqrt(a)),   u = |q| + e q.x - k,
/// e = |f| / (1-fr), k = fr / (1-fr).
std::optional<Place> placeOf(const Gradient& g, bool isRadial, const TileFrame& frame) {
    const auto& m = g.matrix;
    const auto row = [&](dvec2 direction, dvec2 origin, double factor, double more) {
        const dvec2 linear(glm::dot(direction, dvec2(m[0], m[1])), glm::dot(direction, dvec2(m[2], m[3])));
        const double at = glm::dot(linear, frame.corner) + glm::dot(direction, dvec2(m[4], m[5]) - origin);
        return std::array<double, 3>{factor * frame.side * linear.x, factor * frame.side * linear.y,
                                     factor * at + more};
    };
    Place place;
    place.isRadial = isRadial;
    if (!isRadial) {
        place.x = row({1, 0}, {0, 0}, 1, 0);
    } else {
        const dvec2 f(g.fx, g.fy);
        const double focus = glm::length(f), rest = 1 - double(g.fr);
        if (rest - focus < minCircleGap)
            return std::nullopt;
        const double a = rest * rest - focus * focus;
        const dvec2 axis = focus > 0 ? f / focus : dvec2(1, 0), across(-axis.y, axis.x);
        place.x = row(axis, f, rest / a, -focus * double(g.fr) / a);
        place.y = row(across, f, 1 / std::sqrt(a), 0);
        place.e = focus / rest;
        place.start = double(g.fr) / rest;
    }
    return place.isFinite() ? std::optional(place) : std::nullopt;
}

}  // namespace vtm::gl::plain

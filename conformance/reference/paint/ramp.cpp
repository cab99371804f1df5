#include "conformance/reference/paint/ramp.hpp"

#include <algorithm>
#include <cmath>

namespace vtm::reference {
namespace {

double periodOf(scene::Spread spread) {
    switch (spread) {
        case scene::Spread::Repeat:
            return 1;
        case scene::Spread::Reflect:
            return 2;
        default:
            return 0;
    }
}

/// A rise and a fall.
std::vector<scene::GradientStop> mirrored(std::vector<scene::GradientStop> stops) {
    for (std::size_t i = stops.size(); i-- > 0;)
        stops.push_back({2 - stops[i].offset, stops[i].color});
    return stops;
}

Colour straight(const scene::Color& c) { return {c.r, c.g, c.b, c.a}; }

}  // namespace

Colour premultiplied(const Colour& c) { return {c.r * c.a, c.g * c.a, c.b * c.a, c.a}; }

Colour premultiplied(const scene::Color& color) { return premultiplied(straight(color)); }

Ramp::Ramp(std::vector<scene::GradientStop> stops, scene::Spread spread)
    : stops_(spread == scene::Spread::Reflect ? mirrored(std::move(stops)) : std::move(stops)),
      period_(periodOf(spread)) {
    if (period_ > 0)
        mean_ = withinPeriod(0, 0, period_, {}) / period_;
}

std::size_t Ramp::stopsUpTo(double offset) const {
    const auto after =
        std::upper_bound(stops_.begin(), stops_.end(), offset,
                         [](double value, const scene::GradientStop& s) { return value < s.offset; });
    return std::size_t(after - stops_.begin());
}

/// From `from` to `to`; the borders of periods count.
bool Ramp::hasStop(double from, double to) const {
    const double start = period_ > 0 ? period_ * std::floor(from / period_) : 0;
    return (period_ > 0 && to - start >= period_) || stopsUpTo(from - start) != stopsUpTo(to - start);
}

/// `upTo`: how many stops lie before the stretch that holds the offset.
Colour Ramp::between(std::size_t upTo, double offset) const {
    if (upTo == 0)
        return premultiplied(stops_.front().color);
    if (upTo == stops_.size())
        return premultiplied(stops_.back().color);
    const scene::GradientStop &before = stops_[upTo - 1], &after = stops_[upTo];
    const double share = (offset - before.offset) / (double(after.offset) - before.offset);
    return premultiplied(straight(before.color) * (1 - share) + straight(after.color) * share);
}

Colour Ramp::at(double offset) const {
    const double inPeriod = period_ > 0 ? offset - period_ * std::floor(offset / period_) : offset;
    return between(stopsUpTo(inPeriod), inPeriod);
}

bool Ramp::isOpaque() const {
    return std::all_of(stops_.begin(), stops_.end(),
                       [](const scene::GradientStop& s) { return s.color.a >= 1; });
}

/// Of the colour at origin + d times the weight of d, for d from `from` to `to`; all in the first period.
Colour Ramp::withinPeriod(double origin, double from, double to, const Weight& weight) const {
    // Between stops a premultiplied colour is a quadratic: Simpson's rule is exact for cubics.
    Colour sum(0);
    for (std::size_t upTo = stopsUpTo(origin + from); from < to; ++upTo) {
        const double end = upTo == stops_.size() ? to : std::min(to, stops_[upTo].offset - origin);
        if (!(end > from))
            continue;
        const auto value = [&](double d) { return between(upTo, origin + d) * weight(d); };
        sum += (value(from) + value((from + end) / 2) * 4.0 + value(end)) * ((end - from) / 6);
        from = end;
    }
    return sum;
}

Colour Ramp::integral(double origin, double from, double to, const Weight& weight) const {
    if (period_ == 0)
        return withinPeriod(origin, from, to, weight);
    Colour sum(0);
    for (double n = std::floor((origin + from) / period_); from < to; ++n) {
        const double start = origin - n * period_, end = std::min(to, period_ - start);
        sum += withinPeriod(start, from, end, weight);
        from = std::max(from, end);
    }
    return sum;
}

Colour Ramp::over(double offset, double a, double b) const {
    if (a < b)
        std::swap(a, b);
    if (period_ > 0 && a >= period_) {
        // Whole periods have one mean, wherever they begin.
        const double whole = period_ * std::floor(a / period_), rest = a - whole;
        return (mean_ * whole + over(offset - whole / 2, rest, b) * rest) / a;
    }
    const double reach = (a + b) / 2, flat = (a - b) / 2;
    if (!hasStop(offset - reach, offset + reach))
        return at(offset);
    // How likely x + y = d is rises from -reach on, is 1 / a in the middle, and falls.
    Colour sum = integral(offset, -flat, flat, {1 / a, 0});
    if (b > 0) {
        const double slope = 1 / a / b;
        sum += integral(offset, -reach, -flat, {slope * reach, slope});
        sum += integral(offset, flat, reach, {slope * reach, -slope});
    }
    return sum;
}

}  // namespace vtm::reference

#include "conformance/reference/filter/pixels.hpp"

#include <algorithm>
#include <cmath>

namespace vtm::reference {

Colour Pixels::interpolated(double x, double y) const {
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), u = x - 0.5 - left, v = y - 0.5 - top;
    const int i = int(left), j = int(top);
    return (1 - v) * ((1 - u) * get(i, j) + u * get(i + 1, j)) +
           v * ((1 - u) * get(i, j + 1) + u * get(i + 1, j + 1));
}

double Rectangle::share(int x, int y) const {
    const auto along = [](int pixel, double from, double to) {
        return std::clamp(std::min(pixel + 1.0, to) - std::max(double(pixel), from), 0.0, 1.0);
    };
    return along(x, min.x, max.x) * along(y, min.y, max.y);
}

namespace {

/// A function of straight red, green and blue.
template <class Change>
Colour changed(const Colour& c, Change change) {
    if (!(c.a >= 1.0 / 1024))
        return Colour(0);
    const auto channel = [&](double v) { return c.a * change(std::clamp(v / c.a, 0.0, 1.0)); };
    return {channel(c.r), channel(c.g), channel(c.b), c.a};
}

}  // namespace

/// IEC 61966-2-1.
Colour linearised(const Colour& colour) {
    return changed(colour,
                   [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); });
}

Colour encoded(const Colour& colour) {
    return changed(
        colour, [](double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; });
}

}  // namespace vtm::reference

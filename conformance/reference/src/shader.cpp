#include "conformance/reference/src/shader.hpp"

namespace vtm::reference {
namespace {

/// The offset inside [0, 1] that repeats or mirrors to; padding is left to the ramp.
double spreadOffset(double t, scene::Spread spread) {
    if (spread == scene::Spread::Repeat)
        return t - std::floor(t);
    if (spread == scene::Spread::Reflect)
        return 1 - std::abs(t - 2 * std::floor(t / 2) - 1);
    return t;
}

Colour straight(const scene::Color& c) { return {c.r, c.g, c.b, c.a}; }

Colour premultiplied(const Colour& c) { return {c.r * c.a, c.g * c.a, c.b * c.a, c.a}; }

Colour texel(const image::Bitmap& bitmap, double x, double y) {
    const auto column = std::size_t(std::fmin(std::fmax(x, 0.0), bitmap.width - 1.0));
    const auto row = std::size_t(std::fmin(std::fmax(y, 0.0), bitmap.height - 1.0));
    const std::uint8_t* p = &bitmap.rgba[(row * std::size_t(bitmap.width) + column) * 4];
    return premultiplied(Colour(p[0], p[1], p[2], p[3]) / 255.0);
}

Colour bilinear(const image::Bitmap& bitmap, Point p) {
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5);
    const double u = p.x - 0.5 - x, v = p.y - 0.5 - y;
    return (texel(bitmap, x, y) * (1 - u) + texel(bitmap, x + 1, y) * u) * (1 - v) +
           (texel(bitmap, x, y + 1) * (1 - u) + texel(bitmap, x + 1, y + 1) * u) * v;
}

double wrap(double v, double period) {
    const double rest = v - period * std::floor(v / period);
    return rest >= 0 && rest < period ? rest : 0;  // rounding may reach the period
}

}  // namespace

Colour premultiplied(const scene::Color& color) { return premultiplied(straight(color)); }

Colour Ramp::at(double offset) const {
    const double t = spreadOffset(offset, spread_);
    const auto after =
        std::upper_bound(stops_.begin(), stops_.end(), t,
                         [](double value, const scene::GradientStop& s) { return value < s.offset; });
    if (after == stops_.begin())
        return premultiplied(straight(stops_.front().color));
    if (after == stops_.end())
        return premultiplied(straight(stops_.back().color));
    const auto before = after - 1;
    const double share = (t - before->offset) / (double(after->offset) - before->offset);
    return premultiplied(straight(before->color) * (1 - share) + straight(after->color) * share);
}

bool Ramp::isOpaque() const {
    return std::all_of(stops_.begin(), stops_.end(),
                       [](const scene::GradientStop& s) { return s.color.a >= 1; });
}

std::optional<double> RadialShader::offsetAt(Point p) const {
    // |q - t·d| = r0 + t·dr with q from the focus: a·t² - 2·b·t + c = 0.
    const Vector d = gradient.center - gradient.focus, q = p - gradient.focus;
    const double r0 = gradient.focalRadius, dr = gradient.radius - r0;
    const double a = dot(d, d) - dr * dr, b = dot(q, d) + r0 * dr, c = dot(q, q) - r0 * r0;
    const auto hasRadius = [&](double t) { return r0 + t * dr >= 0; };
    if (a == 0) {
        const double t = c / (2 * b);
        return std::isfinite(t) && hasRadius(t) ? std::optional(t) : std::nullopt;
    }
    const double root = std::sqrt(b * b - a * c);
    if (std::isnan(root))
        return std::nullopt;
    const auto [low, high] = std::minmax({(b - root) / a, (b + root) / a});
    if (hasRadius(high))
        return high;
    return hasRadius(low) ? std::optional(low) : std::nullopt;
}

Colour RadialShader::at(Point p) const {
    const auto offset = offsetAt(scene::apply(toPaint, p));
    return offset ? ramp.at(*offset) : Colour(0);
}

Colour ImageShader::at(Point p) const {
    const Point q = scene::apply(toPaint, p);
    return filter == scene::ImageFilter::Nearest ? texel(*bitmap, q.x, q.y) : bilinear(*bitmap, q);
}

Point TileShader::wrapped(Point p) const {
    const Point q = scene::apply(toTile, p);
    return {wrap(q.x, tileSize.x), wrap(q.y, tileSize.y)};
}

}  // namespace vtm::reference

#include "conformance/reference/paint/shader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtm::reference {
namespace {

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

/// Catmull-Rom's cubic through four values, at t between the two in the middle.
template <class Value>
Value catmullRom(const std::array<Value, 4>& v, double t) {
    const Value slope = (v[2] - v[0]) * 0.5, next = (v[3] - v[1]) * 0.5, step = v[2] - v[1];
    return v[1] + (slope + (step * 3.0 - slope * 2.0 - next + (slope + next - step * 2.0) * t) * t) * t;
}

/// valueAt(i) holds from i to i + 1: the mean of what lies within width / 2 of p.
template <class ValueAt>
Colour meanRound(double p, double width, ValueAt&& valueAt) {
    const double from = p - width / 2, to = p + width / 2;
    Colour sum(0);
    for (double i = std::floor(from); i < to; ++i)
        sum += valueAt(i) * (std::min(i + 1, to) - std::max(i, from));
    return sum / width;
}

/// texelAt(i, j) is that of [i, i + 1] × [j, j + 1].
template <class TexelAt>
Colour meanOfSquare(Point p, double width, TexelAt&& texelAt) {
    return meanRound(
        p.y, width, [&](double j) { return meanRound(p.x, width, [&](double i) { return texelAt(i, j); }); });
}

/// Catmull-Rom's cubic through texels; along each axis the rest of `share` is their mean.
Colour bicubic(const image::Bitmap& bitmap, Point p, double share, double width) {
    const auto along = [&](double at, const auto& valueAt) {
        const double first = std::floor(at - 0.5);
        const std::array<Colour, 4> values{valueAt(first - 1), valueAt(first), valueAt(first + 1),
                                           valueAt(first + 2)};
        return catmullRom(values, at - 0.5 - first) * share + meanRound(at, width, valueAt) * (1 - share);
    };
    return along(p.y, [&](double y) { return along(p.x, [&](double x) { return texel(bitmap, x, y); }); });
}

/// What is displayed is a colour; cubics overshoot.
Colour clamped(const Colour& c) {
    const double a = std::clamp(c.a, 0.0, 1.0);
    return {std::clamp(c.r, 0.0, a), std::clamp(c.g, 0.0, a), std::clamp(c.b, 0.0, a), a};
}

double wrap(double v, double period) {
    const double rest = v - period * std::floor(v / period);
    return rest >= 0 && rest < period ? rest : 0;  // rounding may reach the period
}

}  // namespace

Colour LinearShader::over(const Spot& spot) const {
    const Vector step(dot(toPaint[0], gradient), dot(toPaint[1], gradient));
    return ramp.over(dot(scene::apply(toPaint, spot.centre) - start, gradient),
                     std::abs(step.x) * spot.size.x, std::abs(step.y) * spot.size.y);
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

Colour RadialShader::over(const Spot& spot) const {
    const auto at = [&](double x, double y) {
        return offsetAt(scene::apply(toPaint, spot.centre + Vector(x, y) * spot.size / 2.0));
    };
    const auto middle = at(0, 0), left = at(-1, 0), right = at(1, 0), top = at(0, -1), bottom = at(0, 1);
    if (!middle)
        return Colour(0);
    if (!left || !right || !top || !bottom)
        return ramp.at(*middle);
    return ramp.over(*middle, std::abs(*right - *left), std::abs(*bottom - *top));
}

Means::Means(const image::Bitmap& bitmap, double footprint) {
    for (int side = 2; side / 2 < footprint && side / 2 < std::max(bitmap.width, bitmap.height); side *= 2) {
        Level level{(bitmap.width + side - 1) / side, (bitmap.height + side - 1) / side, double(side), {}};
        for (int j = 0; j < level.height; ++j)
            for (int i = 0; i < level.width; ++i) {
                Colour sum(0);
                int count = 0;
                for (int y = j * side; y < std::min((j + 1) * side, bitmap.height); ++y)
                    for (int x = i * side; x < std::min((i + 1) * side, bitmap.width); ++x, ++count)
                        sum += texel(bitmap, x, y);
                level.texels.push_back(sum / double(count));
            }
        levels_.push_back(std::move(level));
    }
}

Colour Means::at(int l, Point p, double width) const {
    const Level& level = levels_[std::min(std::size_t(l), levels_.size()) - 1];
    const auto texelAt = [&](double x, double y) {
        const auto i = std::size_t(std::clamp(x, 0.0, level.width - 1.0));
        const auto j = std::size_t(std::clamp(y, 0.0, level.height - 1.0));
        return level.texels[j * std::size_t(level.width) + i];
    };
    return meanOfSquare(p / level.side, width, texelAt);
}

ImageShader::ImageShader(const Affine& placement, const scene::ImagePaint& paint)
    : toPaint(placement), bitmap(paint.bitmap), filter(paint.filter) {
    // The longest image of a unit vector: its square is the larger eigenvalue of JᵀJ, and of JJᵀ.
    const Vector u = toPaint[0], v = toPaint[1];
    const double half = (dot(u, u) + dot(v, v)) / 2, area = u.x * v.y - u.y * v.x;
    const double longer = std::sqrt(half + std::sqrt(std::max(0.0, half * half - area * area)));
    const double angle =
        std::atan2(2 * (u.x * u.y + v.x * v.y), u.x * u.x + v.x * v.x - u.y * u.y - v.y * v.y) / 2;
    along = {std::cos(angle), std::sin(angle)};
    width = std::max({1.0, std::abs(area) / longer, longer / 16});
    ratio = std::max(1.0, longer / width - 1.0 / 64);
    if (isOfAPixel() && width > 1)
        means = std::make_shared<const Means>(*bitmap, width);
}

Colour ImageShader::at(Point p) const {
    const Point q = scene::apply(toPaint, p);
    if (filter == scene::ImageFilter::Nearest)
        return texel(*bitmap, q.x, q.y);
    if (!isOfAPixel())
        return clamped(bilinear(*bitmap, q));
    // The level on which the pixel is two to four texels wide, or less on the first.
    const int level = std::max(int(std::floor(std::log2(width))) - 1, 0);
    const double texels = width / std::exp2(level), toNext = std::max(0.0, 2 * texels - 7);
    const auto square = [&](Point place) {
        const double cubic = filter == scene::ImageFilter::Bicubic ? std::max(0.0, 1 - 4 * (texels - 1)) : 0;
        if (level == 0 && cubic > 0)
            return bicubic(*bitmap, place, cubic, texels);
        const Colour mean =
            level > 0 ? means->at(level, place, texels)
                      : meanOfSquare(place, texels, [&](double i, double j) { return texel(*bitmap, i, j); });
        return toNext > 0 ? mean * (1 - toNext) + means->at(level + 1, place, texels / 2) * toNext : mean;
    };
    // Squares side by side, of the outermost two what is left.
    Colour sum = square(q);
    for (double rest = (ratio - 1) / 2, i = 1; rest > 0; rest -= 1, i += 1)
        sum = sum + (square(q + along * (i * width)) + square(q - along * (i * width))) * std::min(rest, 1.0);
    return clamped(sum * (1 / ratio));
}

Point TileShader::wrapped(Point p) const {
    const Point q = scene::apply(toTile, p);
    return {wrap(q.x, tileSize.x), wrap(q.y, tileSize.y)};
}

}  // namespace vtm::reference

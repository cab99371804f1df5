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

Colour bicubic(const image::Bitmap& bitmap, Point p) {
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5);
    std::array<Colour, 4> rows;
    for (int j = 0; j < 4; ++j) {
        std::array<Colour, 4> row;
        for (int i = 0; i < 4; ++i)
            row[std::size_t(i)] = texel(bitmap, x + i - 1, y + j - 1);
        rows[std::size_t(j)] = catmullRom(row, p.x - 0.5 - x);
    }
    return catmullRom(rows, p.y - 0.5 - y);
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

Colour Means::at(int l, Point p) const {
    const Level& level = levels_[std::min(std::size_t(l), levels_.size()) - 1];
    const auto texelAt = [&](double x, double y) {
        const auto i = std::size_t(std::clamp(x, 0.0, level.width - 1.0));
        const auto j = std::size_t(std::clamp(y, 0.0, level.height - 1.0));
        return level.texels[j * std::size_t(level.width) + i];
    };
    const double x = p.x / level.side - 0.5, y = p.y / level.side - 0.5;
    const double i = std::floor(x), j = std::floor(y), u = x - i, v = y - j;
    return (texelAt(i, j) * (1 - u) + texelAt(i + 1, j) * u) * (1 - v) +
           (texelAt(i, j + 1) * (1 - u) + texelAt(i + 1, j + 1) * u) * v;
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
    const double level = std::log2(width);
    const int finer = int(level);
    const auto at = [&](int l, Point place) {
        if (l > 0)
            return means->at(l, place);
        return filter == scene::ImageFilter::Bicubic ? bicubic(*bitmap, place) : bilinear(*bitmap, place);
    };
    const auto square = [&](Point place) {
        return level > 0 ? at(finer, place) * (finer + 1 - level) + at(finer + 1, place) * (level - finer)
                         : at(0, place);
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

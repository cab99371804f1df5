#include "compiler/lower/paints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/codec.hpp>

namespace vtm::compiler {
namespace {

using scene::Affine;
using scene::GradientStop;
using scene::Point;
using scene::Spread;

/// A picture that shows this much of a ramp has its stops placed to 2^-18 of its size in single precision.
constexpr double largeShare = 1.0 / 64;
/// Beyond what the picture shows, for filters.
constexpr double rangeMargin = 1.0 / 8;
/// Circles whose radius is as many times the picture's size are straight.
constexpr double straightRadius = 4096;

struct Range {
    double low, high;
    double size() const { return high - low; }
};

/// A stop where it stands on the unrolled ramp.
struct Stop {
    double at;
    scene::Color color;
};

std::array<Point, 4> corners(glm::dvec2 size) {
    return {Point{0, 0}, Point{size.x, 0}, Point{0, size.y}, size};
}

Range shown(const Affine& toRamp, glm::dvec2 size) {
    Range range{toRamp[2].x, toRamp[2].x};
    for (const Point p : corners(size)) {
        const double u = scene::apply(toRamp, p).x;
        range.low = std::min(range.low, u), range.high = std::max(range.high, u);
    }
    const double more = rangeMargin * range.size();
    return {range.low - more, range.high + more};
}

scene::Color interpolated(const scene::Color& a, const scene::Color& b, double share) {
    const auto mix = [&](float x, float y) { return float(double(x) + (double(y) - double(x)) * share); };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b), mix(a.a, b.a)};
}

/// One period, from `start` on; `isTurned`: from its end to its beginning.
void append(std::vector<Stop>& stops, const std::vector<GradientStop>& period, double start, bool isTurned) {
    const auto add = [&](double offset, const scene::Color& color) {
        stops.push_back({start + (isTurned ? 1 - offset : offset), color});
    };
    std::vector<GradientStop> inOrder = period;
    if (isTurned)
        std::reverse(inOrder.begin(), inOrder.end());
    add(isTurned ? 1 : 0, inOrder.front().color);
    for (const GradientStop& s : inOrder)
        add(s.offset, s.color);
    add(isTurned ? 0 : 1, inOrder.back().color);
}

/// All stops that matter in the range.
std::vector<Stop> unrolled(const Ramp& ramp, const Range& range) {
    std::vector<Stop> stops;
    if (ramp.spread == Spread::Pad) {
        append(stops, ramp.stops, 0, false);
        return stops;
    }
    for (double k = std::floor(range.low); k <= std::floor(range.high); ++k)
        append(stops, ramp.stops, k, ramp.spread == Spread::Reflect && std::fmod(k, 2) != 0);
    return stops;
}

/// The colour at u, of stops that do not lie there.
scene::Color colorAt(const std::vector<Stop>& stops, double u) {
    const auto above = std::ranges::upper_bound(stops, u, {}, &Stop::at);
    if (above == stops.begin())
        return stops.front().color;
    const Stop& below = *(above - 1);
    if (above == stops.end())
        return below.color;
    return interpolated(below.color, above->color, (u - below.at) / (above->at - below.at));
}

std::vector<GradientStop> within(const std::vector<Stop>& stops, const Range& range) {
    std::vector<GradientStop> result{{0, colorAt(stops, range.low)}};
    for (const Stop& s : stops)
        if (s.at > range.low && s.at < range.high)
            result.push_back({float((s.at - range.low) / range.size()), s.color});
    result.push_back({1, colorAt(stops, range.high)});
    return result;
}

/// On which of the gradient's circles p lies: the larger u with |p - (1 - u) f| = (1 - u) fr + u.
struct Circle {
    double u, radius;
    Point fromCenter;  ///< to p
};
std::optional<Circle> circleThrough(Point p, Point f, double fr) {
    // |p - f + u f|² = (fr + u (1 - fr))²
    const Point d = p - f;
    const double a = glm::dot(f, f) - (1 - fr) * (1 - fr), b = glm::dot(d, f) - fr * (1 - fr),
                 c = glm::dot(d, d) - fr * fr;
    // Where the focal circle lies inside the end circle a < 0, so the larger root is this one.
    const double root = std::sqrt(b * b - a * c);
    const double u = (-b - root) / a;
    const double radius = fr + u * (1 - fr);
    if (!(a < 0) || !(radius > 0) || !std::isfinite(u))
        return std::nullopt;
    return Circle{u, radius, d + u * f};
}

}  // namespace

std::optional<Ramp> narrowed(const Ramp& ramp, glm::dvec2 size) {
    const Range range = shown(ramp.toRamp, size);
    if (!(range.size() > 0 && range.size() < largeShare))
        return std::nullopt;
    const double scale = 1 / range.size();
    const Point x = ramp.toRamp[0] * scale, y = ramp.toRamp[1] * scale;
    return Ramp{{x, y, {(ramp.toRamp[2].x - range.low) * scale, 0}},
                within(unrolled(ramp, range), range),
                Spread::Pad};
}

std::optional<Ramp> straightened(const scene::RadialGradient& gradient, const Affine& toUnit,
                                 glm::dvec2 size) {
    const Point middle = scene::apply(toUnit, size / 2.0),
                f = (gradient.focus - gradient.center) / gradient.radius;
    double extent = 0;
    for (const Point corner : corners(size))
        extent = std::max(extent, glm::distance(scene::apply(toUnit, corner), middle));
    const double fr = gradient.focalRadius / gradient.radius;
    const std::optional<Circle> circle = circleThrough(middle, f, fr);
    if (!circle || !(circle->radius > straightRadius * extent))
        return std::nullopt;
    // Of F(p, u) = |p - (1 - u) f|² - radius(u)² = 0, half of the derivatives.
    const double byU = glm::dot(circle->fromCenter, f) - circle->radius * (1 - fr);
    const Point slope = circle->fromCenter / -byU;
    if (!std::isfinite(slope.x) || !std::isfinite(slope.y))
        return std::nullopt;
    const Point x = toUnit[0], y = toUnit[1];
    const Point along{glm::dot(slope, x), glm::dot(slope, y)}, across{-along.y, along.x};
    const Affine toRamp{along.x, across.x, along.y, across.y, circle->u - glm::dot(along, size) / 2, 0};
    return Ramp{toRamp, gradient.stops, gradient.spread};
}

namespace {

using scene::Affine;
using scene::compose;
using scene::GradientStop;

/// No point of the picture has a coordinate beyond three times this in a paint's space, so that engines can
/// square coordinates in single precision. A gradient that is shorter than this part of the picture shows its
/// last stop, or the mean of its stops, whether it is enlarged to that length or not.
constexpr double largestPlace = 0x1p60;
/// Neither the focus nor its circle's radius is further from the end circle's centre than this, in its radii,
/// so that engines can multiply four such numbers.
constexpr double farthestFocus = 0x1p30;

std::array<float, 4> premultiplied(const scene::Color& c) { return {c.r * c.a, c.g * c.a, c.b * c.a, c.a}; }

std::uint16_t unorm16(float v) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 65535.0f));
}

bool allOpaque(const std::vector<GradientStop>& stops) {
    return std::all_of(stops.begin(), stops.end(), [](const GradientStop& s) { return s.color.a >= 1; });
}

template <class Record>
void append(std::vector<asset::Texel>& data, const Record& record) {
    static_assert(sizeof(Record) % sizeof(asset::Texel) == 0);
    const std::size_t at = data.size();
    data.resize(at + sizeof(Record) / sizeof(asset::Texel));
    std::memcpy(data.data() + at, &record, sizeof(Record));
}

/// Unit vector of the gradient to the picture: (0, 0) → start, (1, 0) → end.
Affine gradientFrame(const scene::LinearGradient& g) {
    const glm::dvec2 d = g.end - g.start;
    return {d, {-d.y, d.x}, g.start};
}

}  // namespace

std::optional<std::uint32_t> PaintTable::add(const scene::Paint& paint, const Affine& item) {
    if (const auto* color = std::get_if<scene::Color>(&paint))
        return solid(*color);
    if (const auto* g = std::get_if<scene::LinearGradient>(&paint))
        return linear(*g, compose(item, g->transform));
    if (const auto* g = std::get_if<scene::RadialGradient>(&paint))
        return radial(*g, compose(item, g->transform));
    if (const auto* image = std::get_if<scene::ImagePaint>(&paint))
        return bitmap(*image, compose(item, image->transform));
    if (const auto* m = std::get_if<scene::Material>(&paint))
        return material(*m, compose(item, m->transform));
    return std::nullopt;
}

std::array<float, 6> PaintTable::numbers(const Affine& m) const {
    const double side = std::max(size_.x, size_.y);
    double largest = 0;
    for (int row = 0; row < 2; ++row)
        largest =
            std::max({largest, side * std::abs(m[0][row]), side * std::abs(m[1][row]), std::abs(m[2][row])});
    const double scale = std::min(1.0, largestPlace / largest);
    const auto f = [scale](double v) { return static_cast<float>(scale * v); };
    return {f(m[0].x), f(m[0].y), f(m[1].x), f(m[1].y), f(m[2].x), f(m[2].y)};
}

std::uint32_t PaintTable::add(Source source) {
    picture_.sources.push_back(source);
    return static_cast<std::uint32_t>(picture_.sources.size() - 1);
}

std::optional<std::uint32_t> PaintTable::solid(const scene::Color& c) {
    return add({asset::Op::Solid, premultiplied(c), 0, c.a >= 1});
}

std::uint32_t PaintTable::record(asset::Gradient gradient, const std::vector<GradientStop>& stops) {
    const auto at = static_cast<std::uint32_t>(picture_.data.size());
    gradient.stopCount = static_cast<std::uint32_t>(stops.size());
    append(picture_.data, gradient);
    limits::check();
    for (const GradientStop& s : stops)
        append(picture_.data, asset::GradientStop{s.offset,
                                                  {unorm16(s.color.r), unorm16(s.color.g), unorm16(s.color.b),
                                                   unorm16(s.color.a)},
                                                  0});
    return at;
}

std::optional<std::uint32_t> PaintTable::linear(const scene::LinearGradient& g, const Affine& toPicture) {
    const auto inverse = scene::inverse(compose(toPicture, gradientFrame(g)));
    if (!inverse)
        return std::nullopt;
    return ramp({*inverse, g.stops, g.spread});
}

std::uint32_t PaintTable::ramp(const Ramp& whole) {
    const std::optional<Ramp> part = isPart_ ? narrowed(whole, size_) : std::nullopt;
    const Ramp& ramp = part ? *part : whole;
    asset::Gradient gradient;
    gradient.matrix = numbers(ramp.toRamp);
    gradient.spread = static_cast<asset::Spread>(ramp.spread);
    return add({asset::Op::Linear, {}, record(gradient, ramp.stops), allOpaque(ramp.stops)});
}

std::optional<std::uint32_t> PaintTable::radial(const scene::RadialGradient& g, const Affine& toPicture) {
    const auto inverse =
        scene::inverse(compose(toPicture, Affine{g.radius, 0, 0, g.radius, g.center.x, g.center.y}));
    if (!inverse)
        return std::nullopt;
    if (const auto straight = isPart_ ? straightened(g, *inverse, size_) : std::nullopt)
        return ramp(*straight);
    asset::Gradient gradient;
    gradient.matrix = numbers(*inverse);
    gradient.spread = static_cast<asset::Spread>(g.spread);
    const Point focus = (g.focus - g.center) / g.radius;
    const double shrunk = std::min(1.0, farthestFocus / std::max(glm::length(focus), 1.0));
    gradient.fx = static_cast<float>(focus.x * shrunk);
    gradient.fy = static_cast<float>(focus.y * shrunk);
    gradient.fr = static_cast<float>(std::min(g.focalRadius / g.radius, farthestFocus));
    // Circles that do not lie within each other leave a part of the plane free.
    constexpr float minGap = 0x1p-20f;  // more than rounding
    const bool isWhole = std::hypot(gradient.fx, gradient.fy) + gradient.fr <= 1 - minGap;
    return add({asset::Op::Radial, {}, record(gradient, g.stops), isWhole && allOpaque(g.stops)});
}

std::optional<std::uint32_t> PaintTable::bitmap(const scene::ImagePaint& image, const Affine& toPicture) {
    const auto inverse = scene::inverse(toPicture);
    if (!inverse)
        return std::nullopt;
    const auto [found, isNew] =
        images_.try_emplace(image.bitmap.get(), static_cast<std::uint32_t>(picture_.images.size()));
    if (isNew) {
        picture_.images.push_back(image.bitmap);
        imagePixels_ += std::int64_t{image.bitmap->width} * image.bitmap->height;
    }
    if (imagePixels_ > image::maxDecodedPixels)
        throw LimitError("the picture's images have more than " + std::to_string(image::maxDecodedPixels) +
                         " pixels together");
    const auto at = static_cast<std::uint32_t>(picture_.data.size());
    append(picture_.data,
           asset::ImageFill{numbers(*inverse), found->second, static_cast<asset::ImageFilter>(image.filter)});
    return add({asset::Op::Image, {}, at, false});
}

static_assert(scene::maxSide == asset::largestLength && scene::minSide == 1 / asset::largestLength);
static_assert(scene::maxMaterialName == asset::maxMaterialName &&
              scene::maxMaterialText == asset::maxMaterialText);

std::optional<std::uint32_t> PaintTable::material(const scene::Material& m, const Affine& toPicture) {
    const auto inverse = scene::inverse(toPicture);
    if (!inverse)
        return std::nullopt;
    const auto [found, isNew] =
        materials_.try_emplace(m.name, static_cast<std::uint32_t>(picture_.materials.size()));
    if (isNew && picture_.materials.size() >= asset::maxMaterials)
        throw LimitError("the picture has more than " + std::to_string(asset::maxMaterials) + " materials");
    if (isNew)
        picture_.materials.push_back({m.name, m.glsl});
    const auto at = static_cast<std::uint32_t>(picture_.data.size());
    append(picture_.data,
           asset::MaterialFill{numbers(*inverse), found->second, 0, premultiplied(m.fallback)});
    return add({asset::Op::Material, {}, at, false});
}

}  // namespace vtm::compiler

#include "conformance/cases/certify.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <vtm/raster/evaluate.hpp>
#include "conformance/cases/path_points.hpp"

namespace vtm::cases {
namespace {

using scene::Point;

/// Shares of a pixel below it are rounding.
constexpr double negligible = 1e-12;
/// How flat the reference makes outlines, as a share of the tolerance. (Dashes move by what it takes from
/// their path's length.)
constexpr double flatShare = 1.0 / 64;
/// Width of a line that stands for an outline, in pixels.
constexpr double hairline = 1.0 / 64;
/// A view with so many more edges of one stroke than pixels, as where a wide dashed one turns tighter than it
/// is wide, takes the reference minutes: all of it counts as near an outline.
constexpr std::size_t tangled = 400;

/// The least that the map stretches any direction by: its smaller singular value.
double smallestScale(const scene::Affine& m) {
    const double sum = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]), d = std::abs(scene::determinant(m));
    const double larger = std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * d * d))) / 2);
    return larger > 0 ? d / larger : 0;
}

/// Every subpath ended as a fill ends it.
scene::Path closed(const scene::Path& path) {
    scene::Path result;
    for (const scene::Command& command : path) {
        const bool open = !result.empty() && !std::holds_alternative<scene::Close>(result.back());
        if (open && std::holds_alternative<scene::MoveTo>(command))
            result.push_back(scene::Close{});
        result.push_back(command);
    }
    if (!result.empty())
        result.push_back(scene::Close{});
    return result;
}

double largestScale(const scene::Affine& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]));  // an upper bound
}

/// How far a stroke reaches from its path, in the path's space.
double reachOf(const scene::StrokeStyle& style) { return style.width * std::max(1.0, style.miterLimit); }

}  // namespace

scene::Affine toPixels(const Window& window) {
    const double c = std::cos(window.angle) / window.pixel, s = std::sin(window.angle) / window.pixel;
    const Point centre = window.centre;
    return {c,
            s,
            -s,
            c,
            window.pixels / 2.0 - c * centre.x + s * centre.y,
            window.pixels / 2.0 - s * centre.x - c * centre.y};
}

Outlines::Outlines(const scene::Scene& scene) {
    const auto border = scene::rectangle({0, 0}, {scene.width, scene.height});
    add({std::make_shared<scene::Path>(border), scene::identity, scene::FillRule::NonZero});
    add(scene.root);
}

void Outlines::add(Shape shape) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    shape.min = Point(infinity), shape.max = Point(-infinity);
    const auto include = [&](Point p) {
        const Point q = scene::apply(shape.transform, p);
        shape.min = glm::min(shape.min, q), shape.max = glm::max(shape.max, q);
    };
    Point at(0);
    for (const scene::Command& command : *shape.path) {
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            include(quad->control);
        if (const auto* cubic = std::get_if<scene::CubicTo>(&command))
            include(cubic->control1), include(cubic->control2);
        if (const auto* arc = std::get_if<scene::ArcTo>(&command)) {
            const double reach = 2 * (glm::length(arc->radii) + glm::distance(at, arc->to));
            include(at - reach), include(at + reach);
            include(at + Point(reach, -reach)), include(at + Point(-reach, reach));
        }
        if (!std::holds_alternative<scene::Close>(command))
            include(at = *scene::endOf(command));
    }
    if (const auto* style = std::get_if<scene::StrokeStyle>(&shape.geometry)) {
        const double reach = reachOf(*style) * largestScale(shape.transform);
        shape.min -= reach, shape.max += reach;
    }
    shapes_.push_back(std::move(shape));
}

std::vector<const Outlines::Shape*> Outlines::shapesIn(const Window& window) const {
    const double reach = window.pixel * (window.pixels + 2);
    std::vector<const Shape*> shapes;
    for (const Shape& shape : shapes_)
        if (glm::all(glm::lessThan(shape.min, window.centre + reach)) &&
            glm::all(glm::greaterThan(shape.max, window.centre - reach)))
            shapes.push_back(&shape);
    return shapes;
}

void Outlines::add(const scene::Group& group) {
    if (group.clip)
        add(*group.clip);
    if (group.mask)
        add(*group.mask->content);
    for (const scene::Node& node : group.children) {
        if (const auto* child = std::get_if<scene::Group>(&node.value)) {
            add(*child);
            continue;
        }
        const auto& item = std::get<scene::Item>(node.value);
        add({item.path, item.transform, item.geometry});
    }
}

void Outlines::add(const scene::Clip& clip) {
    for (const scene::ClipShape& shape : clip.shapes) {
        add({shape.path, shape.transform, shape.rule});
        if (shape.clip)
            add(*shape.clip);
    }
    if (clip.clip)
        add(*clip.clip);
}

std::vector<bool> Outlines::touched(const Shape& shape, const reference::View& view, double tolerance) {
    const double flatness = flatShare * tolerance * glm::length(view.toPixels[0]);
    std::vector<double> covered;
    std::vector<bool> touched;
    if (const auto* style = std::get_if<scene::StrokeStyle>(&shape.geometry)) {
        const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
        if (reference::strokeEdges(*shape.path, shape.transform, *style, view, flatness) > tangled + pixels)
            return std::vector<bool>(pixels, true);
        covered = reference::strokeCoverage(*shape.path, shape.transform, *style, view, flatness);
        scene::StrokeStyle narrow = *style;
        narrow.width -= 2 * tolerance / smallestScale(shape.transform);
        const std::vector<double> safe =
            narrow.width > 0 ? reference::strokeCoverage(*shape.path, shape.transform, narrow, view, flatness)
                             : std::vector<double>(covered.size());
        for (std::size_t i = 0; i < covered.size(); ++i)
            touched.push_back(covered[i] > negligible && safe[i] < 1 - negligible);
        return touched;
    }
    // Edges that coincide cancel in a fill's coverage, not in that of a line along them.
    scene::StrokeStyle line;
    const scene::Affine m = scene::compose(view.toPixels, shape.transform);
    line.width =
        hairline / std::max({std::abs(m[0].x), std::abs(m[0].y), std::abs(m[1].x), std::abs(m[1].y)});
    covered = reference::strokeCoverage(closed(*shape.path), shape.transform, line, view, flatness);
    for (const double c : covered)
        touched.push_back(c > 0);
    return touched;
}

std::vector<bool> Outlines::touched(const Window& window) const {
    const int n = window.pixels;
    const reference::View view{n, n, toPixels(window)};
    std::vector<bool> near(std::size_t(n) * n);
    for (const Shape* shape : shapesIn(window)) {
        const std::vector<bool> one = touched(*shape, view, window.tolerance);
        std::transform(near.begin(), near.end(), one.begin(), near.begin(), std::logical_or());
    }
    return near;
}

std::vector<double> Outlines::nearShares(const Window& window, int parts) const {
    const Window fine{window.centre, window.pixel / parts, window.pixels * parts, window.tolerance,
                      window.angle};
    const std::vector<bool> near = touched(fine);
    const int n = fine.pixels, reach = int(std::ceil(window.tolerance / fine.pixel));
    const auto isNear = [&](int x, int y) {
        for (int j = std::max(0, y - reach); j <= std::min(n - 1, y + reach); ++j)
            for (int i = std::max(0, x - reach); i <= std::min(n - 1, x + reach); ++i)
                if (near[std::size_t(j * n + i)])
                    return true;
        return false;
    };
    std::vector<double> shares(std::size_t(window.pixels) * window.pixels);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            shares[std::size_t(y / parts * window.pixels + x / parts)] +=
                isNear(x, y) ? 1.0 / (parts * parts) : 0;
    return shares;
}

namespace {

/// Of strokes, so narrow a rim counts as outline, as a share of the reach: far below what is bisected.
constexpr double rimShare = 1.0 / 64;

}  // namespace

bool Outlines::isNear(const Shape& shape, Point point, double reach, double tolerance) {
    constexpr double eighthTurn = 0.7853981633974483;
    for (const double angle : {0.0, eighthTurn})
        if (!touched(shape, {1, 1, toPixels({point, 2 * reach, 1, tolerance, angle})}, tolerance).at(0))
            return false;
    return true;
}

bool Outlines::isNear(Point point, double reach) const {
    const double rim = rimShare * reach;
    return std::ranges::any_of(shapesIn({point, 2 * reach, 1, rim}),
                               [&](const Shape* shape) { return isNear(*shape, point, reach, rim); });
}

double Outlines::distance(Point from, double maximum) const {
    const double rim = rimShare * maximum;
    std::vector<const Shape*> shapes = shapesIn({from, 2 * maximum, 1, rim});
    std::erase_if(shapes, [&](const Shape* shape) { return !isNear(*shape, from, maximum, rim); });
    if (shapes.empty())
        return std::numeric_limits<double>::infinity();
    double low = 0, high = maximum;
    constexpr int halvings = 7;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        const bool any = std::ranges::any_of(
            shapes, [&](const Shape* shape) { return isNear(*shape, from, middle, rim); });
        (any ? high : low) = middle;
    }
    return high;
}

std::vector<bool> Outlines::farPixels(const Window& window) const {
    const int n = window.pixels;
    const std::vector<bool> near = touched(window);
    std::vector<bool> far(near.size());
    for (int y = 1; y < n - 1; ++y)
        for (int x = 1; x < n - 1; ++x) {
            bool any = false;
            for (int j = y - 1; j <= y + 1; ++j)
                for (int i = x - 1; i <= x + 1; ++i)
                    any = any || near[std::size_t(j * n + i)];
            far[std::size_t(y * n + x)] = !any;
        }
    return far;
}

bool Outlines::within(Point centre, double reach, double tolerance) const {
    return touched({centre, 2 * reach, 1, tolerance}).at(0);
}

std::vector<Point> Outlines::somePoints(std::uint64_t seed, int count) const {
    std::mt19937_64 random(seed);
    const auto share = [&] { return std::ldexp(double(random() >> 11), -53); };
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) {
        const Shape& shape = shapes_[random() % shapes_.size()];
        if (shape.path->empty())
            continue;
        const std::size_t k = random() % shape.path->size();
        Point p = interpolate(k == 0 ? Point(0) : scene::endOf((*shape.path)[k - 1]).value_or(Point(0)),
                              (*shape.path)[k], share());
        if (const auto* style = std::get_if<scene::StrokeStyle>(&shape.geometry)) {
            const double angle = 6.283185307179586 * share();
            p += style->width / 2 * Point(std::cos(angle), std::sin(angle));
        }
        points.push_back(scene::apply(shape.transform, p));
    }
    return points;
}

std::vector<OutlinePoint> Outlines::pointsOn(std::uint64_t seed, int count) const {
    std::mt19937_64 random(seed);
    std::vector<OutlinePoint> points;
    for (int i = 0; i < count; ++i) {
        const Shape& shape = shapes_[random() % shapes_.size()];
        const double t = std::ldexp(double(random() >> 11), -53);
        const bool left = random() % 2 == 0;
        if (shape.path->size() < 2)
            continue;
        const std::size_t k = 1 + random() % (shape.path->size() - 1);
        const scene::Command& command = (*shape.path)[k];
        const Point from = scene::endOf((*shape.path)[k - 1]).value_or(Point(0)),
                    along = derivative(from, command, t);
        if (!(glm::length(along) > 0) || std::holds_alternative<scene::Close>((*shape.path)[k - 1]))
            continue;
        Point p = interpolate(from, command, t);
        if (const auto* style = std::get_if<scene::StrokeStyle>(&shape.geometry))
            p += (left ? 0.5 : -0.5) * style->width * glm::normalize(Point(-along.y, along.x));
        const Point tangent = shape.transform[0] * along.x + shape.transform[1] * along.y;
        if (glm::length(tangent) > 0)
            points.push_back(
                {scene::apply(shape.transform, p), glm::normalize(Point(-tangent.y, tangent.x))});
    }
    return points;
}

namespace {

/// How much a channel varies over the pixels about one: outlines being far, its paint does. The mean over a
/// pixel, which the reference takes, is within half of that of its middle, which the asset shows.
float rangeAround(const image::Raster& raster, int x, int y, int channel) {
    float low = raster.pixel(x, y)[channel], high = low;
    for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x - 1; i <= x + 1; ++i) {
            low = std::min(low, raster.pixel(i, j)[channel]);
            high = std::max(high, raster.pixel(i, j)[channel]);
        }
    return high - low;
}

}  // namespace

std::string difference(const scene::Scene& scene, const Outlines& outlines, const asset::Asset& asset,
                       const Window& window, double bound) {
    const int n = window.pixels;
    const std::vector<bool> far = outlines.farPixels(window);
    if (std::ranges::find(far, true) == far.end())
        return {};
    const image::Raster truth = reference::render(scene, {n, n, toPixels(window)},
                                                  {.flatness = flatShare * window.tolerance / window.pixel});
    const image::Raster drawn = asset::evaluate(asset, {n, n, toPixels(window)});
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            for (int c = 0; far[std::size_t(y * n + x)] && c < 4; ++c) {
                const float wanted = truth.pixel(x, y)[c], got = drawn.pixel(x, y)[c];
                if (!(std::abs(wanted - got) <= bound + rangeAround(truth, x, y, c) / 2)) {
                    const Point at =
                        scene::apply(scene::inverse(toPixels(window)).value(), Point(x, y) + 0.5);
                    return fmt::format("channel {} at {}, {} (pixels of {}) is {}, not {}", c, at.x, at.y,
                                       window.pixel, got, wanted);
                }
            }
    return {};
}

bool looksEqualAbout(const asset::Asset& asset, scene::Point p, double pixel) {
    const image::Raster drawn =
        asset::evaluate(asset, {2, 2, {1 / pixel, 0, 0, 1 / pixel, 1 - p.x / pixel, 1 - p.y / pixel}});
    for (std::size_t i = 4; i < drawn.rgba.size(); ++i)
        if (std::abs(drawn.rgba[i] - drawn.rgba[i % 4]) > colourBound)
            return false;
    return true;
}

}  // namespace vtm::cases

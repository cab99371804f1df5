// Views that are compiled for themselves: edges of all kinds lie where closed forms put them, from 1 to 10^9
// times.

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/view.hpp>
#include <vtm/raster/scan.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm::cases {
namespace {

using scene::FillRule;
using scene::Item;
using scene::Path;
using scene::Point;
using Real = long double;

constexpr double side = 512;
constexpr int pixels = 24;
const double zooms[] = {1, 1e3, 1e4, 65536, 1e6, 1e9};

struct Case {
    std::string name;
    scene::Scene scene;
    Point at;  ///< on an edge
    std::function<bool(Real x, Real y)>
        inside;        ///< where the picture is white; elsewhere it is black or transparent
    double worst = 4;  ///< 255ths
};

const scene::Color white{1, 1, 1, 1}, black{0, 0, 0, 1};

scene::Scene pictureOf(std::vector<scene::Node> nodes) {
    scene::Scene scene{side, side, {}};
    scene.root.children = std::move(nodes);
    return scene;
}

Item filled(Path path, scene::Paint paint = white) {
    return {std::make_shared<const Path>(std::move(path)), scene::identity, FillRule::NonZero,
            std::move(paint), 1};
}

Item stroked(Path path, scene::StrokeStyle style) {
    return {std::make_shared<const Path>(std::move(path)), scene::identity, std::move(style), white, 1};
}

Path all() { return scene::rectangle({0, 0}, {side, side}); }

const Point middle{250.3, 261.7};
constexpr double radius = 201.9;

Path circle(double r = radius) {
    const Point left{middle.x - r, middle.y}, right{middle.x + r, middle.y};
    return {scene::MoveTo{left}, scene::ArcTo{{r, r}, 0, false, true, right},
            scene::ArcTo{{r, r}, 0, false, true, left}, scene::Close{}};
}
Point onCircle(double angle, double r = radius) {
    return middle + r * Point{std::cos(angle), std::sin(angle)};
}
Real fromMiddle(Real x, Real y) { return std::hypot(x - Real(middle.x), y - Real(middle.y)); }

/// y = 100 + (x - 256)² / 256 from x = 0 to 512: its control polygon is exact.
Path parabola() { return {scene::MoveTo{{0, 356}}, scene::QuadTo{{256, -156}, {512, 356}}}; }
Real parabolaAt(Real x) { return 100 + (x - 256) * (x - 256) / 256; }
/// The x of the parabola's point that is next to p.
Real footOnParabola(Real x, Real y, Real from) {
    Real t = from;
    for (int i = 0; i < 30; ++i) {
        const Real slope = (t - 256) / 128, off = parabolaAt(t) - y;
        t -= ((t - x) + off * slope) / (1 + slope * slope + off / 128);
    }
    return t;
}
Real lengthOfParabola(Real x) {  // from its vertex
    const Real slope = (x - 256) / 128;
    return 64 * (slope * std::sqrt(1 + slope * slope) + std::asinh(slope));
}

scene::StrokeStyle styleOf(double width) {
    scene::StrokeStyle style;
    style.width = width;
    return style;
}

Case circleCase() {
    return {"circle", pictureOf({{filled(circle())}}), onCircle(0.7),
            [](Real x, Real y) { return fromMiddle(x, y) < radius; }};
}

Case parabolaCase() {
    return {
        "parabola", pictureOf({{filled(parabola())}}), {97.3, double(parabolaAt(97.3L))}, [](Real x, Real y) {
            return y > parabolaAt(x);
        }};
}

/// Two triangles that abut: what shines through would be seen.
Case seamCase() {
    const Point a{3.1, 7.7}, b{508.9, 499.3}, c{500.1, 2.3}, d{9.9, 505.5};
    Path one = scene::polygon({a, b, c}), other = scene::polygon({b, a, d});
    return {"seam", pictureOf({{filled(one)}, {filled(other)}}), a + (b - a) * 0.37,
            [](Real, Real) { return true; }};
}

Case lineCase() {
    const Point a{3.1, 7.7}, b{508.9, 499.3}, c{500.1, 2.3};
    const auto isRight = [a, b](Real x, Real y) {
        return (Real(b.x) - Real(a.x)) * (y - Real(a.y)) - (Real(b.y) - Real(a.y)) * (x - Real(a.x)) < 0;
    };
    return {"line", pictureOf({{filled(scene::polygon({a, b, c}))}}), a + (b - a) * 0.37, isRight};
}

Case circleStrokeCase(double sideOf) {
    constexpr double width = 6.4;
    const auto inside = [](Real x, Real y) { return std::abs(fromMiddle(x, y) - radius) < width / 2; };
    return {sideOf > 0 ? "circle-stroke-outside" : "circle-stroke-inside",
            pictureOf({{stroked(circle(), styleOf(width))}}), onCircle(2.2, radius + sideOf * width / 2),
            inside};
}

Case parabolaStrokeCase(double sideOf) {
    constexpr Real width = 6.4L, foot = 97.3L;
    const Real slope = (foot - 256) / 128, share = Real(sideOf) * width / 2 / std::sqrt(1 + slope * slope);
    const auto inside = [](Real x, Real y) {
        const Real f = footOnParabola(x, y, foot);
        return std::hypot(x - f, y - parabolaAt(f)) < width / 2;
    };
    return {sideOf > 0 ? "parabola-stroke-below" : "parabola-stroke-above",
            pictureOf({{stroked(parabola(), styleOf(double(width)))}}),
            {double(foot - slope * share), double(parabolaAt(foot) + share)},
            inside};
}

/// Deep inside of a stroke nothing of it is seen.
Case coveredCase() {
    const Real foot = 97.3L;
    return {"covered",
            pictureOf({{stroked(parabola(), styleOf(6.4))}}),
            {double(foot) + 0.6, double(parabolaAt(foot))},
            [](Real x, Real y) {
                const Real f = footOnParabola(x, y, 97.3L);
                return std::hypot(x - f, y - parabolaAt(f)) < 3.2L;
            }};
}

Case dashedLineCase() {
    scene::StrokeStyle style = styleOf(11.3);
    style.dashes = {7.3, 3.1};
    style.dashPhase = 1.7;
    const auto inside = [](Real x, Real y) {
        return std::fmod(x - 3.7L + 1.7L, 10.4L) < 7.3L && std::abs(y - 200.3L) < 11.3L / 2;
    };
    // The 31st dash's end.
    return {"dashed-line",
            pictureOf({{stroked({scene::MoveTo{{3.7, 200.3}}, scene::LineTo{{509.1, 200.3}}}, style)}}),
            {3.7 - 1.7 + 30 * 10.4 + 7.3, 201.4},
            inside};
}

Case dashedParabolaCase() {
    scene::StrokeStyle style = styleOf(9.1);
    style.dashes = {7.3, 3.1};
    const auto along = [](Real x, Real y) {
        return lengthOfParabola(footOnParabola(x, y, 200)) - lengthOfParabola(0);
    };
    Real foot = 200;  // where the 20th dash ends
    for (int i = 0; i < 50; ++i)
        foot -= (lengthOfParabola(foot) - lengthOfParabola(0) - (19 * 10.4L + 7.3L)) /
                std::sqrt(1 + (foot - 256) * (foot - 256) / (128 * 128));
    return {"dashed-parabola",
            pictureOf({{stroked(parabola(), style)}}),
            {double(foot), double(parabolaAt(foot))},
            [along](Real x, Real y) {
                const Real f = footOnParabola(x, y, 200);
                return std::hypot(x - f, y - parabolaAt(f)) < 9.1L / 2 &&
                       std::fmod(along(x, y), 10.4L) < 7.3L;
            }};
}

Case miterCase() {
    scene::StrokeStyle style = styleOf(8);
    style.miterLimit = 20;
    // Two legs of slope ±4/3; the tip lies a radius over the sine of half the angle beyond.
    const Path path{scene::MoveTo{{160, 400}}, scene::LineTo{{250, 280}}, scene::LineTo{{340, 400}}};
    const auto inside = [](Real x, Real y) {
        const Real down = y - 280, across = std::abs(x - 250);
        return std::abs(0.6L * down - 0.8L * across) < 4;
    };
    return {"miter", pictureOf({{stroked(path, style)}}), {250, 280 - 4 / 0.6}, inside};
}

Case roundCapCase() {
    scene::StrokeStyle style = styleOf(8);
    style.cap = scene::Cap::Round;
    return {"round-cap",
            pictureOf({{stroked({scene::MoveTo{{100.1, 99.3}}, scene::LineTo{{300, 99.3}}}, style)}}),
            {100.1 - 4 * 0.6, 99.3 + 4 * 0.8},
            [](Real x, Real y) {
                return x < Real(100.1) ? std::hypot(x - Real(100.1), y - Real(99.3)) < 4
                                       : std::abs(y - Real(99.3)) < 4;
            }};
}

Case clipCase() {
    scene::Group group;
    auto clip = std::make_shared<scene::Clip>();
    clip->shapes.push_back(
        {std::make_shared<const Path>(circle()), scene::identity, FillRule::NonZero, nullptr});
    group.clip = clip;
    group.children.push_back({filled(all())});
    return {"clip", pictureOf({{group}}), onCircle(4.1),
            [](Real x, Real y) { return fromMiddle(x, y) < radius; }};
}

Case maskCase() {
    auto content = std::make_shared<scene::Group>();
    content->children.push_back({filled(circle())});
    scene::Group group;
    group.mask = std::make_shared<const scene::Mask>(scene::Mask{content, scene::MaskKind::Luminance, false});
    group.children.push_back({filled(all())});
    return {"mask", pictureOf({{group}}), onCircle(5.6),
            [](Real x, Real y) { return fromMiddle(x, y) < radius; }};
}

Case patternCase() {
    auto tile = std::make_shared<scene::Group>();
    tile->children.push_back({filled(scene::rectangle({0, 0}, {3.3, 7.9}))});
    scene::Pattern pattern{{0, 0}, {7.3, 7.9}, tile, scene::translation(0.6, 0.2)};
    const auto inside = [](Real x, Real) { return std::fmod(x - Real(0.6), 7.3L) < 3.3L; };
    return {"pattern", pictureOf({{filled(all(), pattern)}}), {0.6 + 52 * 7.3 + 3.3, 413.9}, inside};
}

/// Black up to an offset, white beyond.
std::vector<scene::GradientStop> sharp() {
    return {{0, black}, {0.375f, black}, {0.375f, white}, {1, white}};
}

Case linearCase(scene::Spread spread) {
    const Point start{11.3, 17.9}, end{400.7, 333.1};
    const Real x = Real(end.x) - Real(start.x), y = Real(end.y) - Real(start.y);
    const double period = spread == scene::Spread::Pad ? 0 : -1;
    const auto inside = [=](Real px, Real py) {
        Real u = ((px - Real(start.x)) * x + (py - Real(start.y)) * y) / (x * x + y * y);
        if (spread != scene::Spread::Pad)
            u += 2;
        if (spread == scene::Spread::Repeat)
            u -= std::floor(u);
        return u > 0.375L;
    };
    Point at = start + (end - start) * 0.375;
    if (spread == scene::Spread::Repeat)  // in another period, where the picture still is
        at = start + Point{-double(y), double(x)} * 0.1 + (end - start) * (0.375 + period + 1);
    return {spread == scene::Spread::Repeat ? "linear-repeated" : "linear",
            pictureOf({{filled(all(), scene::LinearGradient{start, end, sharp(), spread})}}), at, inside};
}

Case radialCase() {
    scene::RadialGradient gradient{middle, radius, middle, 0, sharp()};
    // Where single precision and straight circles are equally far off: docs/regions.md.
    constexpr double worst = 50;
    return {"radial", pictureOf({{filled(all(), gradient)}}), onCircle(1.1, 0.375 * radius),
            [](Real x, Real y) { return fromMiddle(x, y) > 0.375L * Real(radius); }, worst};
}

/// Under a transform that turns and enlarges by a lot.
Case transformedCase() {
    Item item = filled(scene::polygon({{-1e-3, -1e-3}, {1e-3, -1e-3}, {1e-3, 1e-3}, {-1e-3, 1e-3}}));
    item.transform = {8e4, 6e4, -6e4, 8e4, 256.1, 250.7};
    return {"transformed",
            pictureOf({{item}}),
            {256.1 + 80 + 0.3 * 60, 250.7 + 60 - 0.3 * 80},
            [](Real x, Real y) {
                const Real dx = x - Real(256.1), dy = y - Real(250.7);
                return std::abs(0.8L * dx + 0.6L * dy) < 100 && std::abs(-0.6L * dx + 0.8L * dy) < 100;
            }};
}

/// The picture's own corner.
Case borderCase() {
    return {"border",
            pictureOf({{filled(scene::rectangle({-100, -100}, {600, 600}))}}),
            {side, side},
            [](Real x, Real y) { return x < Real(side) && y < Real(side); }};
}

std::vector<Case> cases() {
    return {circleCase(),
            parabolaCase(),
            seamCase(),
            lineCase(),
            circleStrokeCase(1),
            circleStrokeCase(-1),
            parabolaStrokeCase(1),
            parabolaStrokeCase(-1),
            coveredCase(),
            dashedLineCase(),
            dashedParabolaCase(),
            miterCase(),
            roundCapCase(),
            clipCase(),
            maskCase(),
            patternCase(),
            linearCase(scene::Spread::Pad),
            linearCase(scene::Spread::Repeat),
            radialCase(),
            transformedCase(),
            borderCase()};
}

compiler::Part partAt(Point at, double zoom) {
    const double extent = pixels * 0.5 / zoom;  // half a unit a pixel at 1
    return {at.x - extent * 0.47, at.y - extent * 0.53, extent, extent};
}

/// The share of each pixel that is inside, from points in it.
double shareInside(const Case& c, const compiler::Part& part, int x, int y) {
    constexpr int parts = 40;
    const Real px = Real(part.width) / pixels / parts, py = Real(part.height) / pixels / parts;
    int count = 0;
    for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i)
            count += c.inside(Real(part.x) + (Real(x * parts + i) + 0.5L) * px,
                              Real(part.y) + (Real(y * parts + j) + 0.5L) * py);
    return double(count) / (parts * parts);
}

struct Seen {
    double worst = 0;  ///< 255ths
    int edges = 0;     ///< pixels that are neither inside nor outside
};

Seen look(const Case& c, const compiler::Part& part, const image::Raster& drawn) {
    Seen seen;
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            const double truth = shareInside(c, part, x, y);
            seen.edges += truth > 0 && truth < 1;
            seen.worst = std::max(seen.worst, 255 * std::abs(truth - double(drawn.pixel(x, y)[0])));
        }
    return seen;
}

image::Raster scanned(const compiler::ViewResult& made) {
    return asset::Scanner(made.result.asset).draw(made.view);
}

std::string nameOf(const testing::TestParamInfo<Case>& tested) {
    std::string name = tested.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

class DeepZoom : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Edge, DeepZoom, testing::ValuesIn(cases()), nameOf);

TEST_P(DeepZoom, isAsExactAsNone) {
    const Case& c = GetParam();
    for (const double zoom : zooms) {
        const compiler::Part part = partAt(c.at, zoom);
        const compiler::ViewResult made = compiler::compileView(c.scene, part, pixels, pixels);
        EXPECT_TRUE(made.result.warnings.empty()) << made.result.warnings.front();
        const Seen seen = look(c, part, scanned(made));
        EXPECT_LE(seen.worst, c.worst) << c.name << " at " << zoom;
        const bool isEdge = c.name != "seam" && c.name != "covered";
        EXPECT_TRUE(!isEdge || zoom == 1 || seen.edges >= pixels / 2) << c.name << " at " << zoom;
        RecordProperty(fmt::format("worst_{}", zoom), std::to_string(seen.worst));
    }
}

TEST_P(DeepZoom, assetsTellHowFine) {
    const Case& c = GetParam();
    for (const double zoom : zooms) {
        const compiler::ViewResult made = compiler::compileView(c.scene, partAt(c.at, zoom), pixels, pixels);
        const asset::Asset& asset = made.result.asset;
        ASSERT_TRUE(asset.finestPixel);
        EXPECT_LE(*asset.finestPixel * made.view.toPixels[0].x, 1);
        EXPECT_EQ(asset::read(asset::write(asset)).finestPixel, asset.finestPixel);
        EXPECT_EQ(asset::Scanner(asset).finestPixel(), asset.finestPixel);
    }
}

}  // namespace
}  // namespace vtm::cases

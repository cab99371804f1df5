// Glyphs of Debian's fonts against the reference, at sizes from 6 to 500 px and at random angles. Some of
// them by default, an angle a size; every one, at 20 angles, with VTM_GLYPHS=all in the environment.
#include <gtest/gtest.h>
#include <hb.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <span>
#include <tuple>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/scan.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"
#include "text/font_set.hpp"

namespace vtm::cases {
namespace {

using scene::Affine;
using scene::Point;

constexpr double compiledSize = 500;
/// Sizes of a glyph's views, each at an angle of its own. A view of 500 px takes longer than all others.
constexpr double someViews[]{6, 8, 12, 16, 48, 500};
constexpr double allViews[]{6, 6, 6, 6, 8, 8, 8, 8, 12, 12, 12, 12, 16, 16, 16, 16, 48, 48, 48, 500};
static_assert(std::size(allViews) == 20);
constexpr double maxError = 4, maxRms = 0.5;  // in 1/255
/// Words of Arabic calligraphy are drawn at the sizes at which they are no longer than this, in pixels.
constexpr double maxLength = 4096;

bool isAll() {
    const char* wanted = std::getenv("VTM_GLYPHS");
    return wanted && std::string(wanted) == "all";
}

struct Bounds {
    Point min{HUGE_VAL}, max{-HUGE_VAL};

    void add(Point p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y)};
    }
};

/// Controls included.
Bounds boundsOf(const scene::Path& path) {
    Bounds bounds;
    for (const scene::Command& command : path) {
        if (const auto end = scene::endOf(command))
            bounds.add(*end);
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            bounds.add(quad->control);
        if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            bounds.add(cubic->control1);
            bounds.add(cubic->control2);
        }
    }
    return bounds;
}

/// The glyph at compiledSize, alone.
scene::Scene sceneOf(const text::Font& font, const std::shared_ptr<const scene::Path>& path) {
    const double scale = compiledSize / font.unitsPerEm();
    const Bounds bounds = boundsOf(*path);
    scene::Item item;
    item.path = path;
    item.transform =
        scene::compose(scene::scaling(scale, scale), scene::translation(-bounds.min.x, -bounds.min.y));
    item.geometry = scene::FillRule::NonZero;
    item.paint = scene::Color{};
    scene::Scene scene;
    scene.width = std::max(1.0, scale * (bounds.max.x - bounds.min.x));
    scene.height = std::max(1.0, scale * (bounds.max.y - bounds.min.y));
    scene.root.children = {{item}};
    return scene;
}

/// The whole glyph, at a size in pixels, turned about its corner.
asset::View viewOf(const scene::Scene& scene, double size, double angle) {
    const double c = std::cos(angle) * size / compiledSize, s = std::sin(angle) * size / compiledSize;
    const Affine turned{c, s, -s, c, 0, 0};
    Bounds bounds;
    for (const Point corner :
         {Point(0, 0), Point(scene.width, 0), Point(0, scene.height), Point(scene.width, scene.height)})
        bounds.add(scene::apply(turned, corner));
    asset::View view;
    view.width = int(std::ceil(bounds.max.x - bounds.min.x)) + 1;
    view.height = int(std::ceil(bounds.max.y - bounds.min.y)) + 1;
    view.toPixels = scene::compose(scene::translation(-bounds.min.x, -bounds.min.y), turned);
    return view;
}

/// So that no test takes long: part i has every parts()-th glyph from i on.
unsigned parts() { return isAll() ? 32 : 1; }

class Glyphs : public testing::TestWithParam<std::tuple<const char*, unsigned>> {
protected:
    void SetUp() override {
        text::FontQuery query;
        const char* const family = std::get<0>(GetParam());
        query.families = {family};
        if (!set_.hasFamily(family))
            GTEST_SKIP() << "the font " << family << " is not installed";
        font_ = set_.primary(query);
    }

    void expectAgreement(text::GlyphId glyph, std::mt19937& random) {
        const auto path = font_->outlineOf(glyph);
        const scene::Scene scene = path ? sceneOf(*font_, path) : scene::Scene{};
        if (!path)
            return;
        const asset::Asset asset = compiler::compile(scene).asset;
        const asset::Scanner scanner(asset);
        std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
        const double length = std::max(scene.width, scene.height) / compiledSize;
        for (const double size : isAll() ? std::span<const double>(allViews) : someViews)
            if (length * size <= maxLength)
                expectAgreement(glyph, scene, scanner, size, turn(random));
    }

    void expectAgreement(text::GlyphId glyph, const scene::Scene& scene, const asset::Scanner& scanner,
                         double size, double angle) {
        const asset::View view = viewOf(scene, size, angle);
        const image::Raster drawn = scanner.draw(view);
        const image::Raster expected =
            reference::render(scene, {view.width, view.height, view.toPixels}, {.samples = 1});
        const compare::Difference d = compare::compare(drawn, expected);
        EXPECT_LE(d.max, maxError) << "glyph " << glyph << " at " << size << " px, angle " << angle;
        EXPECT_LE(d.rms, maxRms) << "glyph " << glyph << " at " << size << " px, angle " << angle;
        worst_ = std::max(worst_, d.max);
        worstRms_ = std::max(worstRms_, d.rms);
        ++count_;
    }

    text::FontSet set_{text::FontOptions{}};
    std::shared_ptr<const text::Font> font_;
    double worst_ = 0, worstRms_ = 0;
    int count_ = 0;
};

TEST_P(Glyphs, AreThoseOfTheReference) {
    constexpr unsigned someGlyphs = 30;
    const unsigned glyphs = hb_face_get_glyph_count(hb_font_get_face(font_->harfbuzz()));
    const unsigned step = isAll() ? parts() : std::max(1u, glyphs / someGlyphs);
    const unsigned part = std::get<1>(GetParam());
    std::mt19937 random(15 + part);
    for (text::GlyphId glyph = part; glyph < glyphs; glyph += step)
        expectAgreement(glyph, random);
    RecordProperty("views", count_);
    RecordProperty("max255", std::to_string(worst_));
    RecordProperty("rms255", std::to_string(worstRms_));
    EXPECT_GT(count_, 0);
}

std::string nameOf(const testing::TestParamInfo<std::tuple<const char*, unsigned>>& part) {
    std::string name = std::get<0>(part.param) + std::string("_") + std::to_string(std::get<1>(part.param));
    std::erase(name, ' ');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Debian, Glyphs,
                         testing::Combine(testing::Values("DejaVu Serif", "DejaVu Sans", "DejaVu Sans Mono",
                                                          "Amiri", "WenQuanYi Micro Hei"),
                                          testing::Range(0u, parts())),
                         nameOf);

}  // namespace
}  // namespace vtm::cases

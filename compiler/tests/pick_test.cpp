#include <vtm/compiler/pick.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vtm::compiler {
namespace {

using scene::Color;
using scene::Group;
using scene::Item;
using scene::Path;

using Picked = std::optional<std::uint32_t>;
constexpr Picked nothing = std::nullopt;

Item rect(glm::dvec2 min, glm::dvec2 max, scene::Paint paint = Color{0.5f, 0.5f, 0.5f, 1}) {
    Item item;
    item.path = std::make_shared<Path>(scene::rectangle({min.x, min.y}, {max.x, max.y}));
    item.geometry = scene::FillRule::NonZero;
    item.paint = std::move(paint);
    return item;
}

std::shared_ptr<const scene::Clip> clipTo(glm::dvec2 min, glm::dvec2 max) {
    const Item shape = rect(min, max);
    auto clip = std::make_shared<scene::Clip>();
    clip->shapes.push_back({shape.path, scene::identity, scene::FillRule::NonZero, nullptr});
    return clip;
}

PickMap mapOf(const scene::Scene& scene) { return compilePickMap(scene); }

TEST(Pick, TheTopmostOfEqualPaints) {
    scene::Scene scene{64, 64, {}};
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), {10, 10}, {20, 20}})
        scene.root.children.push_back({rect(corner, corner + 24.0)});
    const PickMap map = mapOf(scene);
    ASSERT_EQ(map.items.size(), 3u);
    EXPECT_EQ(map.items[1], &std::get<Item>(scene.root.children[1].value));
    EXPECT_EQ(itemAt(map, {5, 5}), 0u);
    EXPECT_EQ(itemAt(map, {12, 12}), 1u);
    EXPECT_EQ(itemAt(map, {22, 22}), 2u);
    EXPECT_EQ(itemAt(map, {5, 40}), nothing);
    EXPECT_EQ(itemAt(map, {-5, 5}), nothing);
    // Both sides of a border, a ten thousandth of a pixel away.
    EXPECT_EQ(itemAt(map, {5, 9.9999}), 0u);
    EXPECT_EQ(itemAt(map, {20 - 1e-4, 33}), 1u);
    EXPECT_EQ(itemAt(map, {20 + 1e-4, 33}), 2u);
}

TEST(Pick, HoweverTransparent) {
    scene::Scene scene{64, 64, {}};
    Group faint;
    faint.opacity = 0;
    faint.blend = scene::BlendMode::Multiply;
    faint.children.push_back({rect({30, 0}, {50, 50}, Color{1, 1, 1, 0})});
    Item pale = rect({0, 0}, {20, 20});
    pale.opacity = 0.25f;
    scene.root.children = {{std::move(pale)}, {std::move(faint)}};
    const PickMap map = mapOf(scene);
    EXPECT_EQ(itemAt(map, {10, 10}), 0u);
    EXPECT_EQ(itemAt(map, {40, 10}), 1u);
    EXPECT_EQ(itemAt(map, {25, 10}), nothing);
}

TEST(Pick, ClipsHolesAndStrokes) {
    scene::Scene scene{64, 64, {}};
    Group clipped;
    clipped.clip = clipTo({0, 0}, {32, 64});
    Item frame = rect({8, 8}, {56, 56});
    auto path = std::make_shared<Path>(*frame.path);
    const Path hole = scene::rectangle({20, 20}, {28, 28});
    path->insert(path->end(), hole.begin(), hole.end());
    frame.path = path;
    frame.geometry = scene::FillRule::EvenOdd;
    clipped.children.push_back({frame});
    Item stroke = rect({40, 20}, {52, 40});
    scene::StrokeStyle style;
    style.width = 4;
    stroke.geometry = style;
    scene.root.children = {{std::move(clipped)}, {std::move(stroke)}};
    const PickMap map = mapOf(scene);
    EXPECT_EQ(itemAt(map, {10, 10}), 0u);
    EXPECT_EQ(itemAt(map, {24, 24}), nothing);
    EXPECT_EQ(itemAt(map, {36, 10}), nothing);
    EXPECT_EQ(itemAt(map, {31.999, 10}), 0u);
    EXPECT_EQ(itemAt(map, {40, 30}), 1u);
    EXPECT_EQ(itemAt(map, {38.001, 30}), 1u);
    EXPECT_EQ(itemAt(map, {37.999, 30}), nothing);
    EXPECT_EQ(itemAt(map, {46, 30}), nothing);
}

TEST(Pick, MasksThatLetNothingThroughCut) {
    scene::Scene scene{64, 64, {}};
    for (const auto kind : {scene::MaskKind::Luminance, scene::MaskKind::Alpha}) {
        auto content = std::make_shared<Group>();
        content->children.push_back({rect({0, 0}, {40, 64}, Color{0.25f, 0.5f, 0, 0.5f})});
        content->children.push_back({rect({10, 0}, {20, 64}, Color{0, 0, 0, 0.75f})});
        content->children.push_back({rect({24, 0}, {30, 64}, Color{1, 1, 1, 0})});
        Group masked;
        masked.mask =
            std::make_shared<scene::Mask>(scene::Mask{content, kind, kind == scene::MaskKind::Luminance});
        masked.children.push_back({rect({0, 0}, {64, 64})});
        scene.root.children = {{rect({0, 32}, {64, 64})}, {std::move(masked)}};
        const PickMap map = mapOf(scene);
        EXPECT_EQ(itemAt(map, {5, 10}), 1u);
        EXPECT_EQ(itemAt(map, {15, 10}), kind == scene::MaskKind::Alpha ? Picked(1) : nothing);
        EXPECT_EQ(itemAt(map, {15, 40}), kind == scene::MaskKind::Alpha ? 1u : 0u);
        EXPECT_EQ(itemAt(map, {27, 10}), 1u);
        EXPECT_EQ(itemAt(map, {50, 10}), nothing);
    }
}

TEST(Pick, SidesOfSelections) {
    const auto side = [](const Item& item) {
        Group group;
        group.children.push_back({item});
        return std::make_shared<const Group>(group);
    };
    const Item half = rect({0, 0}, {32, 64}), whole = rect({0, 0}, {64, 64});
    scene::Select select{{half.path, scene::identity, scene::FillRule::NonZero}, side(whole), side(whole)};
    scene::Scene scene{64, 64, {}};
    scene.root.children = {{std::move(select)}};
    const PickMap map = mapOf(scene);
    ASSERT_EQ(map.items.size(), 2u);
    EXPECT_EQ(itemAt(map, {10, 10}), 0u);
    EXPECT_EQ(itemAt(map, {40, 10}), 1u);
}

/// Points on both sides of a circle, as near as the tolerance allows, against the circle's equation.
TEST(Pick, CurvesWithinTheTolerance) {
    scene::Scene scene{64, 64, {}};
    Item item = rect({0, 0}, {1, 1});
    item.path =
        std::make_shared<Path>(Path{scene::MoveTo{{52, 32}}, scene::ArcTo{{20, 20}, 0, false, true, {12, 32}},
                                    scene::ArcTo{{20, 20}, 0, false, true, {52, 32}}, scene::Close{}});
    scene.root.children = {{std::move(item)}};
    const PickMap map = mapOf(scene);
    constexpr double away = 1.01 * 64 / 65536;  // the tolerance, and a hundredth
    for (int i = 0; i < 720; ++i) {
        const double angle = i * std::numbers::pi / 360 + 0.001;
        const glm::dvec2 direction(std::cos(angle), std::sin(angle));
        EXPECT_EQ(itemAt(map, glm::dvec2(32) + direction * (20 - away)), 0u) << i;
        EXPECT_EQ(itemAt(map, glm::dvec2(32) + direction * (20 + away)), nothing) << i;
    }
}

TEST(Pick, LimitsAreErrors) {
    Options compat;
    compat.mode = asset::Mode::Compat;
    EXPECT_THROW(compilePickMap({8, 8, {}}, compat), std::invalid_argument);
    scene::Scene many{8, 8, {}};
    for (std::size_t i = 0; i <= maxPickItems; ++i)
        many.root.children.push_back({rect({0, 0}, {1, 1})});
    EXPECT_THROW(compilePickMap(many), LimitError);
    const PickMap empty = compilePickMap({8, 8, {}});
    EXPECT_EQ(itemAt(empty, {4, 4}), nothing);
}

}  // namespace
}  // namespace vtm::compiler

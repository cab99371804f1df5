// Scenes as author's trees and back: the same tree whoever made the scene.
#include <gtest/gtest.h>

#include <random>

#include <vtm/authoring.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>
#include "conformance/compare/compare.hpp"
#include "conformance/reference/reference.hpp"

namespace vtm {
namespace {

scene::Item square(double at, scene::Paint paint) {
    return {std::make_shared<const scene::Path>(scene::rectangle({at, at}, {at + 10, at + 10})),
            scene::translation(1, 2), scene::FillRule::EvenOdd, std::move(paint), 0.5f};
}

scene::Scene sceneOf(std::vector<scene::Node> nodes) {
    scene::Scene scene{64, 64, {}};
    scene.root.children = std::move(nodes);
    return scene;
}

TEST(FromScene, PaintersOrderIsAChainOfSelections) {
    const scene::Item first = square(0, scene::Color{1, 0, 0, 1}),
                      second = square(5, scene::Color{0, 1, 0, 1});
    const Vtm top = Vtm::fromScene(sceneOf({{first}, {second}}));
    const auto& select = std::get<SelectNode>(top.node()->value);
    EXPECT_EQ(select.mask.path, second.path);
    const auto& inside = std::get<LayerNode>(select.inside.node()->value);
    EXPECT_EQ(inside.below, select.outside);  // T_1 on both sides
    const auto& paint = std::get<PlacedNode>(inside.top.node()->value);
    EXPECT_EQ(paint.transform, second.transform);
    EXPECT_EQ(std::get<PaintNode>(paint.content.node()->value).opacity, 0.5f);
    const auto& below = std::get<SelectNode>(select.outside.node()->value);
    EXPECT_EQ(below.mask.path, first.path);
    EXPECT_EQ(below.outside, Vtm());
}

TEST(FromScene, ComesBackAsItWas) {
    scene::Group group;
    group.opacity = 0.25f;
    group.blend = scene::BlendMode::Screen;
    group.children = {{square(2, scene::Color{})}, {square(3, scene::Color{0, 0, 1, 1})}};
    group.mask = std::make_shared<scene::Mask>(scene::Mask{std::make_shared<scene::Group>(group)});
    scene::Group isolated;
    isolated.children = {{square(7, scene::Color{})}, {group}};
    const auto content = std::make_shared<const scene::Group>(group);
    group.blend = scene::BlendMode::Normal;
    const auto side = std::make_shared<const scene::Group>(group);
    scene::Select select{{square(0, scene::Color{}).path, scene::identity, scene::StrokeStyle{}}, side, side};
    const scene::Pattern pattern{{0, 0}, {4, 4}, content, scene::scaling(2, 2)};
    scene::Scene scene =
        sceneOf({{square(0, pattern)}, {group}, {select}, {isolated}, {square(4, scene::Color{})}});
    EXPECT_EQ(scene::dump(Vtm::fromScene(scene).toScene(64, 64)), scene::dump(scene));
    scene.root.opacity = 0.5f;
    EXPECT_EQ(scene::dump(Vtm::fromScene(scene).toScene(64, 64)), scene::dump(scene));
}

TEST(FromScene, ALongChainTakesNoStackAndNoMoreItems) {
    constexpr std::size_t count = 300'000;
    const scene::Item item = square(0, scene::Color{1, 0, 0, 1});
    const scene::Scene scene = sceneOf(std::vector<scene::Node>(count, {item}));
    EXPECT_EQ(Vtm::fromScene(scene).toScene(64, 64).root.children.size(), count);
}

std::shared_ptr<const scene::Filter> blur() {
    scene::FilterPrimitive primitive;
    primitive.operation = scene::GaussianBlurFilter{2, 2};
    primitive.inputs.resize(1);
    primitive.max = {64, 64};
    scene::Filter filter;
    filter.max = {64, 64};
    filter.primitives.push_back(primitive);
    return std::make_shared<const scene::Filter>(filter);
}

TEST(FromScene, GroupsWithFiltersStayEvenIfTheyAreEmpty) {
    scene::Group full, empty;
    empty.filter = full.filter = blur();
    full.children = {{square(2, scene::Color{})}};
    const scene::Scene scene = sceneOf({{square(0, scene::Color{})}, {full}, {empty}});
    EXPECT_EQ(scene::dump(Vtm::fromScene(scene).toScene(64, 64)), scene::dump(scene));
}

TEST(FromScene, AFilterDoesNotMoveOutOfASelection) {
    const Vtm ground = Vtm::fromScene(sceneOf({{square(0, scene::Color{})}}));
    const Vtm top = Vtm::fromScene(sceneOf({{square(5, scene::Color{})}}));
    const Mask mask = filled(scene::rectangle({3, 3}, {9, 9}));
    const scene::Group root =
        Vtm::select(mask, Vtm::layer(top, ground, {.filter = blur()}), ground).toScene(64, 64).root;
    ASSERT_EQ(root.children.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<scene::Select>(root.children[0].value));
}

class Example : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(FromScene, Example,
                         testing::Values("lighthouse", "rose_window", "gauge", "planet", "blend"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Example, LooksTheSameAsATreeOfSelections) {
    const std::string path = std::string(VTM_SOURCE_DIR) + "/examples/" + GetParam() + ".svg";
    const scene::Scene scene = svg::load(image::readFile(path)).scene;
    const scene::Scene back = Vtm::fromScene(scene).toScene(scene.width, scene.height);
    scene::validate(back);
    EXPECT_EQ(scene::dump(back), scene::dump(scene));
    const double scale = 96 / scene.width;
    const reference::View view{96, int(scene.height * scale), scene::scaling(scale, scale)};
    EXPECT_LT(compare::compare(reference::render(back, view), reference::render(scene, view)).max, 1e-3);
}

}  // namespace
}  // namespace vtm

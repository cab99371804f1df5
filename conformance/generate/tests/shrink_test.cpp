#include <cmath>

#include <gtest/gtest.h>

#include "conformance/generate/generate.hpp"

namespace vtm::generate {
namespace {

using scene::Scene;

const scene::Item* firstItem(const scene::Group& group) {
    for (const scene::Node& node : group.children) {
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            return item;
        if (const auto* item = firstItem(std::get<scene::Group>(node.value)))
            return item;
    }
    return nullptr;
}

bool holdsCubic(const scene::Group& group) {
    for (const scene::Node& node : group.children) {
        if (const auto* child = std::get_if<scene::Group>(&node.value)) {
            if (holdsCubic(*child))
                return true;
            continue;
        }
        for (const scene::Command& command : *std::get<scene::Item>(node.value).path)
            if (std::holds_alternative<scene::CubicTo>(command))
                return true;
    }
    return false;
}

/// "There is a cubic in it" leaves a cubic after a move, black, filled, with round numbers.
TEST(Shrink, LeavesOnlyWhatMatters) {
    int shrunk = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Scene scene = randomScene(seed);
        if (!holdsCubic(scene.root))
            continue;
        ++shrunk;
        const Scene small = shrink(scene, [](const Scene& s) { return holdsCubic(s.root); });
        ASSERT_TRUE(holdsCubic(small.root));
        ASSERT_EQ(small.root.children.size(), 1u) << dump(small);
        const scene::Item* item = firstItem(small.root);
        ASSERT_TRUE(item);
        EXPECT_EQ(item->path->size(), 2u) << dump(small);
        EXPECT_EQ(std::get<scene::Color>(item->paint), scene::Color{});
        EXPECT_TRUE(std::holds_alternative<scene::FillRule>(item->geometry));
        const auto& cubic = std::get<scene::CubicTo>(item->path->back());
        EXPECT_EQ(cubic.to.x, std::round(cubic.to.x / 8) * 8) << dump(small);
    }
    EXPECT_GE(shrunk, 10);
}

TEST(Shrink, KeepsWhatCannotBeSmaller) {
    const Scene scene = randomScene(7);
    const std::string text = dump(scene);
    EXPECT_EQ(dump(shrink(scene, [&](const Scene& s) { return dump(s) == text; })), text);
}

TEST(Shrink, AsksNoMoreOftenThanItMay) {
    int asked = 0;
    shrink(
        randomScene(3), [&](const Scene&) { return ++asked, true; }, 10);
    EXPECT_LE(asked, 10);
}

}  // namespace
}  // namespace vtm::generate

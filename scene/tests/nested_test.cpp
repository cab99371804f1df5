// Scenes nested a million levels deep, along every way in which a part can hold another one.
#include <vtm/scene/nested.hpp>

#include <gtest/gtest.h>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {
namespace {

constexpr int depth = 1'000'000;

std::shared_ptr<const Path> square() {
    static const auto path = std::make_shared<const Path>(rectangle({0, 0}, {1, 1}));
    return path;
}

/// Wraps a group in another one, a million times, and asks of the scene what can be asked.
template <class Wrap>
void expectBounded(Wrap wrap) {
    Scene scene{1, 1, {}};
    for (int i = 0; i < depth; ++i) {
        Group outer;
        wrap(outer, std::move(scene.root));
        scene.root = std::move(outer);
    }
    EXPECT_THROW(validate(scene), InvalidScene);
    EXPECT_LT(dump(scene).size(), 100u << 20);
}

std::shared_ptr<const Group> shared(Group group) { return std::make_shared<const Group>(std::move(group)); }

TEST(Nested, Groups) {
    expectBounded([](Group& outer, Group inner) { outer.children.push_back({std::move(inner)}); });
}

TEST(Nested, Masks) {
    expectBounded([](Group& outer, Group inner) {
        outer.mask = std::make_shared<const Mask>(Mask{shared(std::move(inner))});
    });
}

TEST(Nested, Sides) {
    expectBounded([](Group& outer, Group inner) {
        outer.children.push_back(
            {Select{{square(), identity, FillRule::NonZero}, shared(std::move(inner)), nullptr}});
    });
}

TEST(Nested, Patterns) {
    expectBounded([](Group& outer, Group inner) {
        Item item{square(), identity, FillRule::NonZero, Pattern{{0, 0}, {1, 1}, shared(std::move(inner))}};
        outer.children.push_back({std::move(item)});
    });
}

TEST(Nested, Clips) {
    std::shared_ptr<const Clip> clip;
    for (int i = 0; i < depth; ++i) {
        Clip outer;
        outer.clip = std::move(clip);
        clip = std::make_shared<const Clip>(std::move(outer));
    }
    Scene scene{1, 1, {}};
    scene.root.clip = std::move(clip);
    EXPECT_THROW(validate(scene), InvalidScene);
    EXPECT_FALSE(dump(scene).empty());
}

TEST(Nested, ClipsOfShapes) {
    std::shared_ptr<const Clip> clip;
    for (int i = 0; i < depth; ++i) {
        Clip outer;
        outer.shapes.push_back({square(), identity, FillRule::NonZero, std::move(clip)});
        clip = std::make_shared<const Clip>(std::move(outer));
    }
    Scene scene{1, 1, {}};
    scene.root.clip = std::move(clip);
    EXPECT_THROW(validate(scene), InvalidScene);
    EXPECT_FALSE(dump(scene).empty());
}

TEST(Nested, CopyingGroupsIsBounded) {
    Group root;
    for (int i = 0; i < depth; ++i) {
        Group outer;
        outer.children.push_back({std::move(root)});
        root = std::move(outer);
    }
    EXPECT_THROW(const Group copy(root), InvalidScene);
    Group assigned;
    EXPECT_THROW(assigned = root, InvalidScene);
    EXPECT_THROW(const Group again(root), InvalidScene);  // what was thrown has left nothing behind
}

TEST(Nested, WhatIsSharedOutlivesItsHolder) {
    auto inner = std::make_shared<const Clip>(Clip{{}, std::make_shared<const Clip>()});
    { const Clip outer{{}, inner}; }
    EXPECT_EQ(inner.use_count(), 1);
    EXPECT_NE(inner->clip, nullptr);
}

}  // namespace
}  // namespace vtm::scene

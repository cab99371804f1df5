// Limits of time, memory and nesting, as the compiler holds them.
#include <vtm/limits/limits.hpp>

#include <gtest/gtest.h>

#include <optional>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/pick.hpp>
#include <vtm/compiler/session.hpp>
#include "limits/testing.hpp"
#include "paper/compile.hpp"

namespace vtm::compiler {
namespace {

using limits::Budget;
using limits::Exceeded;
using limits::testing::onSmallStack;
using scene::Path;
using scene::Point;
using scene::Scene;

std::shared_ptr<const Path> circle(Point centre, double radius) {
    const Point left(centre.x - radius, centre.y), right(centre.x + radius, centre.y);
    return std::make_shared<const Path>(
        Path{scene::MoveTo{left}, scene::ArcTo{{radius, radius}, 0, false, true, right},
             scene::ArcTo{{radius, radius}, 0, false, true, left}, scene::Close{}});
}

/// Translucent circles, so many that compiling them takes many seconds.
Scene crowd() {
    Scene scene{100, 100, {}};
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        scene::Item item{circle({i * 37 % 101, i * 53 % 103}, 20 + i % 7), scene::identity,
                         scene::FillRule::NonZero, scene::Color{1, 0, 0, 0.1f}};
        item.place = {i + 1, 7, "circle"};
        scene.root.children.push_back({std::move(item)});
    }
    return scene;
}

template <class Function>
std::optional<Exceeded> exceededBy(limits::Limits limits, Function work) {
    Budget budget(std::move(limits));
    const limits::Scope scope(budget);
    try {
        work();
    } catch (const Exceeded& exceeded) {
        return exceeded;
    }
    return std::nullopt;
}

TEST(CompilerLimits, SecondsNameTheElement) {
    const Scene scene = crowd();
    const auto exceeded = exceededBy({.seconds = 0.3}, [&] { compile(scene); });
    ASSERT_TRUE(exceeded);
    EXPECT_EQ(exceeded->limit(), limits::Limit::Seconds);
    EXPECT_FALSE(exceeded->stage().empty());
    EXPECT_GT(exceeded->place().line, 0u);
    EXPECT_STREQ(exceeded->place().element, "circle");
}

TEST(CompilerLimits, Memory) {
    const Scene scene = crowd();
    const std::size_t maximum = limits::residentBytes() + (60u << 20);
    const auto exceeded = exceededBy({.memoryBytes = maximum}, [&] { compile(scene); });
    ASSERT_TRUE(exceeded);
    EXPECT_EQ(exceeded->limit(), limits::Limit::Memory);
}

TEST(CompilerLimits, TheCallbackCancels) {
    const Scene scene = crowd();
    const auto exceeded = exceededBy({.proceed = [](const limits::Progress& p) { return p.seconds < 0.1; }},
                                     [&] { compile(scene); });
    ASSERT_TRUE(exceeded);
    EXPECT_EQ(exceeded->limit(), limits::Limit::Cancelled);
}

TEST(CompilerLimits, EveryWayOfCompilingHolds) {
    const Scene scene = crowd();
    Options compat;
    compat.mode = asset::Mode::Compat;
    EXPECT_TRUE(exceededBy({.seconds = 0.1}, [&] { compile(scene, compat); }));
    EXPECT_TRUE(exceededBy({.seconds = 0.1}, [&] { paper::compile(scene); }));
    EXPECT_TRUE(exceededBy({.seconds = 0.1}, [&] { compilePickMap(scene); }));
    EXPECT_TRUE(exceededBy({.seconds = 0.1}, [&] { Session{scene}; }));
}

TEST(CompilerLimits, DashesAreLimitedWhereTheyAreMade) {
    Scene scene{100, 100, {}};
    scene::StrokeStyle style;
    style.dashes = {0.0013, 0.0012};
    scene::Item item{circle({50, 50}, 40), scene::identity, style, scene::Color{0, 0, 0, 1}};
    item.place = {3, 5, "circle"};
    scene.root.children.push_back({std::move(item)});
    const auto exceeded = exceededBy({.seconds = 0.02}, [&] { compile(scene); });
    ASSERT_TRUE(exceeded);
    EXPECT_EQ(exceeded->place().line, 3u);
}

TEST(CompilerLimits, WhatWasStoppedCanBeDoneAgain) {
    Scene small{10, 10, {}};
    small.root.children.push_back({scene::Item{circle({5, 5}, 4), scene::identity, scene::FillRule::NonZero,
                                               scene::Color{1, 0, 0, 1}}});
    Session session(small);
    const std::size_t leaves = session.result().asset.leaves.size();
    const Scene scene = crowd();
    EXPECT_TRUE(exceededBy({.seconds = 0.1}, [&] { session.update(scene); }));
    EXPECT_EQ(session.result().asset.leaves.size(), leaves);
    EXPECT_NO_THROW(session.update(small));
    EXPECT_EQ(session.result().asset.leaves.size(), leaves);
}

Scene nested(int levels) {
    Scene scene{10, 10, {}};
    scene.root.children.push_back({scene::Item{circle({5, 5}, 4), scene::identity, scene::FillRule::NonZero,
                                               scene::Color{1, 0, 0, 1}}});
    for (int i = 0; i < levels; ++i) {
        scene::Group outer;
        outer.opacity = 0.999f;
        outer.children.push_back({std::move(scene.root)});
        scene.root = std::move(outer);
    }
    return scene;
}

TEST(CompilerLimits, ScenesNestedAMillionLevels) {
    const Scene scene = nested(1'000'000);
    onSmallStack([&] {
        EXPECT_THROW(compile(scene), scene::InvalidScene);
        EXPECT_THROW(paper::compile(scene), scene::InvalidScene);
        EXPECT_THROW(compilePickMap(scene), scene::InvalidScene);
        EXPECT_THROW(Session{scene}, scene::InvalidScene);
    });
}

TEST(CompilerLimits, AsDeepAsScenesMayBeOnASmallStack) {
    const Scene scene = nested(scene::maxNesting - 1);
    onSmallStack([&] {
        EXPECT_NO_THROW(compile(scene));
        EXPECT_NO_THROW(paper::compile(scene));
        EXPECT_NO_THROW(compilePickMap(scene));
        EXPECT_NO_THROW(Session{scene});
    });
}

}  // namespace
}  // namespace vtm::compiler

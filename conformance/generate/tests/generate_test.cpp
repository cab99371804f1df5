#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "conformance/generate/damage.hpp"
#include "conformance/generate/generate.hpp"

namespace vtm::generate {

namespace {

TEST(RandomScene, IsValid) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed)
        ASSERT_NO_THROW(scene::validate(randomScene(seed))) << seed;
}

TEST(RandomScene, DependsOnItsSeedOnly) {
    std::set<std::string> all;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        all.insert(scene::dump(randomScene(seed)));
        EXPECT_EQ(scene::dump(randomScene(seed)), scene::dump(randomScene(seed)));
    }
    EXPECT_EQ(all.size(), 100u);
}

TEST(HardScenes, AreValidAndDependOnTheirSeedOnly) {
    std::set<std::string> names, all;
    for (const Family& family : hardFamilies()) {
        EXPECT_TRUE(names.insert(family.name).second) << family.name;
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            ASSERT_NO_THROW(scene::validate(family.make(seed))) << family.name << " " << seed;
            EXPECT_EQ(scene::dump(family.make(seed)), scene::dump(family.make(seed)));
            all.insert(scene::dump(family.make(seed)));
        }
    }
    EXPECT_EQ(all.size(), 100 * names.size());
}

/// What a scene's text mentions, counted over a thousand scenes.
TEST(RandomScene, HasEveryKindOfPart) {
    for (const char* part :
         {"nonzero", "evenodd", "stroke", "butt", "square", "miter-clip", "bevel", "dashes", "clip",
          "multiply", "linear", "radial", "opacity", "matrix", " A ", " C ", " Q ", " Z"}) {
        int count = 0;
        for (std::uint64_t seed = 0; seed < 1000; ++seed)
            count += scene::dump(randomScene(seed)).find(part) != std::string::npos;
        EXPECT_GE(count, 20) << part;
    }
}

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

using Bytes = std::vector<std::uint8_t>;

TEST(Damage, ChangesWhatThereIs) {
    const Bytes whole(1000, ' ');
    std::mt19937_64 random(1);
    int shorter = 0, digits = 0;
    constexpr int rounds = 200;
    for (int i = 0; i < rounds; ++i) {
        const Bytes bytes = damaged(whole, random);
        EXPECT_NE(bytes, whole);
        EXPECT_LE(bytes.size(), whole.size() + 8);
        shorter += bytes.size() + 8 < whole.size();
        for (const std::uint8_t byte : bytes)
            digits += byte >= '0' && byte <= '9';
    }
    EXPECT_GT(shorter, rounds / 16);
    EXPECT_LT(shorter, rounds / 4);
    EXPECT_GT(digits, 2 * rounds);
}

TEST(Damage, IsTheSameForASeed) {
    const Bytes whole(100, 'a');
    std::mt19937_64 one(5), same(5), other(6);
    EXPECT_EQ(damaged(whole, one), damaged(whole, same));
    EXPECT_NE(damaged(whole, one), damaged(whole, other));
}

TEST(Damage, LeavesNothingOfNothing) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 50; ++i) {
        EXPECT_TRUE(damaged({}, random).empty());
        EXPECT_LE(damaged({1}, random).size(), 9u);
    }
}

}  // namespace

}  // namespace vtm::generate

// The colour of a stack whose layers come and go, against layers composited one by one.

#include "compiler/direct/stack_tree.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "compiler/direct/layer_cover.hpp"

namespace vtm::compiler {
namespace {

/// Layers in groups that are translucent: `parents` of groups, and the group of each layer.
struct Stack {
    LoweredScene picture;
    std::vector<std::uint32_t> around;  ///< by group
    std::vector<std::uint32_t> groups;  ///< by layer
    std::vector<glm::vec4> colors;

    StackTree tree() const { return {picture, colors, groups, around}; }
    std::uint32_t addGroup(std::uint32_t parent, float opacity) {
        LoweredGroup group;
        group.parent = parent;
        group.opacity = opacity;
        picture.groups.push_back(group);
        const auto number = std::uint32_t(picture.groups.size() - 1);
        around.push_back(opacity < 1 ? number : parent == noIndex ? noIndex : around[parent]);
        return number;
    }
    void addLayer(std::uint32_t group, std::mt19937& random, float leastAlpha, float mostAlpha) {
        const auto share = [&] { return float(random() % 1001) / 1000; };
        const float alpha = leastAlpha + (mostAlpha - leastAlpha) * share();
        colors.push_back({alpha * share(), alpha * share(), alpha * share(), alpha});
        groups.push_back(group == noIndex ? noIndex : around[group]);
    }
    std::uint32_t groupRound(std::uint32_t group) const {
        const std::uint32_t parent = picture.groups[group].parent;
        return parent == noIndex ? noIndex : around[parent];
    }
    bool isIn(std::uint32_t layer, std::uint32_t group) const {
        std::uint32_t g = groups[layer];
        while (g != noIndex && g != group)
            g = groupRound(g);
        return g == group;
    }
    /// Of layers [first, end), which are all in the group: from the bottom.
    glm::vec4 composite(const std::vector<bool>& inside, std::uint32_t group, std::uint32_t first,
                        std::uint32_t end) const {
        glm::vec4 below(0);
        for (std::uint32_t layer = first; layer < end;) {
            glm::vec4 color = inside[layer] ? colors[layer] : glm::vec4(0);
            std::uint32_t next = layer + 1;
            if (groups[layer] != group) {
                std::uint32_t child = groups[layer];
                while (groupRound(child) != group)
                    child = groupRound(child);
                while (next < end && isIn(next, child))
                    ++next;
                color = picture.groups[child].opacity * composite(inside, child, layer, next);
            }
            below = color + (1 - color.w) * below;
            layer = next;
        }
        return below;
    }
};

void expectColors(const Stack& stack, std::mt19937& random, int changes) {
    const auto count = std::uint32_t(stack.colors.size());
    StackTree tree = stack.tree();
    std::vector<std::uint64_t> bits(count / 64 + 1);
    std::vector<bool> inside(count);
    for (int i = 0; i < changes; ++i) {
        for (auto turns = random() % 6; turns > 0; --turns) {
            const auto layer = std::uint32_t(random() % count);
            inside[layer] = !inside[layer];
            bits[layer / 64] ^= std::uint64_t{1} << layer % 64;
            tree.change(layer);
        }
        const StackColor found = tree.color(bits);
        const glm::vec4 expected = stack.composite(inside, noIndex, 0, count);
        for (int c = 0; c < 4; ++c)
            ASSERT_NEAR(found.color[c], expected[c], 1.5f * unseen) << i;
        // What is below shows no more than nobody sees, and what is above does.
        std::vector<bool> above = inside;
        std::fill(above.begin(), above.begin() + found.hidden, false);
        ASSERT_NEAR(stack.composite(above, noIndex, 0, count).w, expected.w, 1.01f * unseen) << i;
        if (found.hidden > 0)
            ASSERT_LE(1 - stack.composite(above, noIndex, 0, count).w, 1.01f * unseen) << i;
        else
            ASSERT_GE(1 - expected.w, 0.99f * unseen * unseen) << i;
    }
}

TEST(StackTree, IsTheColorOfTheStack) {
    std::mt19937 random(1);
    for (const float alpha : {0.01f, 0.1f, 0.6f, 1.0f}) {
        Stack stack;
        for (int layer = 0; layer < 1000; ++layer)
            stack.addLayer(noIndex, random, 0, alpha);
        expectColors(stack, random, 1500);
    }
}

TEST(StackTree, FindsWhatIsHidden) {
    Stack stack;
    std::mt19937 random(2);
    for (int layer = 0; layer < 500; ++layer)
        stack.addLayer(noIndex, random, 0.1f, 0.1f);
    StackTree tree = stack.tree();
    const std::vector<std::uint64_t> all(8, ~std::uint64_t{0});
    const StackColor found = tree.color(all);
    const auto needed = std::uint32_t(std::ceil(std::log(unseen) / std::log(0.9f)));
    EXPECT_EQ(found.hidden, 500 - needed);
    EXPECT_NEAR(found.color.w, 1, 1.1f * unseen);
}

TEST(StackTree, GroupsAreCompositedTogether) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        Stack stack;
        const std::uint32_t root = stack.addGroup(noIndex, 1);
        while (stack.colors.size() < 600) {
            std::uint32_t group = root;
            for (auto depth = random() % 4; depth > 0; --depth) {
                group = stack.addGroup(group, random() % 4 == 0 ? 1 : float(1 + random() % 9) / 10);
                for (auto layers = random() % 20; layers > 0; --layers)
                    stack.addLayer(group, random, 0, random() % 3 == 0 ? 1 : 0.3f);
            }
            for (auto layers = random() % 3; layers > 0; --layers)
                stack.addLayer(root, random, 0, 0.3f);
        }
        expectColors(stack, random, 300);
    }
}

}  // namespace
}  // namespace vtm::compiler

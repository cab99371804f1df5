// Chains that stay inside their layer whatever the order in which they cross: against all orders there are.

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "compiler/containers/min_tree.hpp"
#include "compiler/direct/quiet_chains.hpp"

namespace vtm::compiler {
namespace {

/// Whether the chain may have a winding number without the sign of `base` on a side, in an order that keeps
/// chains apart whose columns are.
bool mayShow(const std::vector<ReachingChain>& chains, std::size_t of, int base) {
    std::vector<std::size_t> order(chains.size());
    std::iota(order.begin(), order.end(), 0);
    bool shows = false;
    do {
        bool isPossible = true;
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t k = i + 1; k < order.size(); ++k)
                isPossible &= chains[order[i]].left <= chains[order[k]].right;
        if (!isPossible)
            continue;
        int winding = base;
        for (const std::size_t i : order) {
            const int after = winding + chains[i].winding;
            shows |= i == of && (winding == 0 || after == 0 || (winding > 0) != (after > 0));
            winding = after;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return shows;
}

TEST(QuietChains, NeverShow) {
    std::mt19937_64 random(1);
    std::size_t quiet = 0;
    QuietChains found;
    for (int round = 0; round < 400; ++round) {
        std::vector<ReachingChain> chains(2 + random() % 5);
        for (ReachingChain& c : chains) {
            c.left = float(random() % 8);
            c.right = c.left + float(random() % 3);
            c.winding = random() % 2 == 0 ? 1 : -1;
        }
        const int base = int(random() % 9) - 4;
        found.find(chains, base);
        for (std::size_t i = 0; i < chains.size(); ++i)
            if (found.isQuiet(i)) {
                ++quiet;
                EXPECT_FALSE(mayShow(chains, i, base)) << round << ", " << i;
            }
    }
    EXPECT_GT(quiet, 300u);
}

TEST(QuietChains, TellWhatTheyAddOnTheLeft) {
    QuietChains quiet;
    quiet.find(std::vector<ReachingChain>{{0, 1, 1}, {2, 3, 1}, {4, 6, -1}}, 5);
    EXPECT_EQ(quiet.count(), 3u);
    EXPECT_EQ(quiet.windingLeftOf(-1), 0);
    EXPECT_EQ(quiet.windingLeftOf(1.5f), 1);
    EXPECT_EQ(quiet.windingLeftOf(5), std::nullopt);
    EXPECT_EQ(quiet.windingLeftOf(7), 1);
}

TEST(MinTree, TellsTheFirstOfTheLeast) {
    std::mt19937_64 random(2);
    MinTree tree;
    for (std::size_t count = 1; count < 20; ++count) {
        std::vector<float> values(count);
        tree.assign(count, [&](std::size_t i) { return values[i] = float(random() % 10); });
        for (int change = 0; change < 50; ++change) {
            const auto least = std::ranges::min_element(values);
            EXPECT_EQ(tree.least(), *least);
            EXPECT_EQ(tree.indexOfLeast(), std::size_t(least - values.begin()));
            const std::size_t i = random() % count;
            tree.set(i, values[i] = float(random() % 10));
        }
    }
}

}  // namespace
}  // namespace vtm::compiler

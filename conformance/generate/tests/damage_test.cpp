#include "conformance/generate/damage.hpp"

#include <gtest/gtest.h>

namespace vtm::generate {
namespace {

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

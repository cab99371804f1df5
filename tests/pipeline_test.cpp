// The fuzz target `pipeline` on random bytes and on what it once found, in every test run.

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "tests/fuzz/pipeline_run.hpp"

namespace vtm::fuzz {
namespace {

TEST(Pipeline, RandomScenes) {
    std::array<int, 3> outcomes{};
    for (unsigned seed = 1; seed <= 600; ++seed) {
        std::mt19937 random(seed);
        std::vector<std::uint8_t> bytes(40 + random() % 400);
        for (std::uint8_t& byte : bytes)
            byte = std::uint8_t(random() >> 24);
        bytes[0] %= 4;  // no SVG
        SCOPED_TRACE(seed);
        Outcome outcome{};
        EXPECT_NO_THROW(outcome = runPipeline(bytes));
        ++outcomes[std::size_t(outcome)];
    }
    EXPECT_LT(outcomes[0], 60) << "refused";
    EXPECT_GT(outcomes[2], 80) << "compared with the reference";
}

}  // namespace
}  // namespace vtm::fuzz

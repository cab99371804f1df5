// Random sequences of OpenVG calls: whatever the arguments, an answer within reasonable time and no crash.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/fuzz/openvg_calls.hpp"

namespace {

TEST(OpenVgCalls, RandomProgramsEnd) {
    constexpr unsigned programs = 600;
    constexpr std::size_t programBytes = 4096;
    std::size_t calls = 0;
    std::vector<std::uint8_t> bytes(programBytes);
    for (unsigned seed = 1; seed <= programs; ++seed) {
        std::mt19937 random(seed);
        for (std::uint8_t& byte : bytes)
            byte = std::uint8_t(random() >> 24);
        calls += vtm::fuzz::runOpenVgCalls(bytes);
    }
    EXPECT_GT(calls, 100'000u);
}

}  // namespace

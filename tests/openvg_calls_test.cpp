// Random sequences of OpenVG calls: whatever the arguments, an answer within reasonable time and no crash.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "tests/fuzz/openvg_calls.hpp"

namespace {

/// With VTM_TEST_ALL a million calls and more by each compositor.
unsigned numberOfPrograms(unsigned sampled) { return std::getenv("VTM_TEST_ALL") ? 6000 : sampled; }

std::vector<std::uint8_t> randomProgram(unsigned seed) {
    std::vector<std::uint8_t> bytes(4096);
    std::mt19937 random(seed);
    for (std::uint8_t& byte : bytes)
        byte = std::uint8_t(random() >> 24);
    return bytes;
}

TEST(OpenVgCalls, RandomProgramsEnd) {
    const unsigned programs = numberOfPrograms(600);
    std::size_t calls = 0;
    for (unsigned seed = 1; seed <= programs; ++seed)
        calls += vtm::fuzz::runOpenVgCalls(randomProgram(seed));
    EXPECT_GT(calls, 100'000u);
}

TEST(OpenVgCalls, BothCompositorsDrawRandomProgramsAlike) {
    const unsigned programs = numberOfPrograms(300);
    for (unsigned seed = 1; seed <= programs; ++seed) {
        const std::vector<std::uint8_t> bytes = randomProgram(seed);
        const auto cpu = vtm::fuzz::drawnByOpenVgCalls(bytes, VTM_COMPOSITOR_CPU),
                   gl = vtm::fuzz::drawnByOpenVgCalls(bytes, VTM_COMPOSITOR_GL);
        ASSERT_EQ(cpu.size(), gl.size());
        for (std::size_t i = 0; i < cpu.size(); ++i) {
            ASSERT_EQ(cpu[i].pixels.size(), gl[i].pixels.size());
            int largest = 0;
            for (std::size_t k = 0; k < cpu[i].pixels.size(); ++k)
                largest = std::max(largest, std::abs(int(cpu[i].pixels[k]) - int(gl[i].pixels[k])));
            EXPECT_LE(largest, 1) << "program " << seed << ", surface " << i;
        }
    }
}

}  // namespace

// Random sequences of OpenVG calls: whatever the arguments, an answer within reasonable time and no crash.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/fuzz/openvg_calls.hpp"

namespace {

std::vector<std::uint8_t> randomProgram(unsigned seed) {
    std::vector<std::uint8_t> bytes(4096);
    std::mt19937 random(seed);
    for (std::uint8_t& byte : bytes)
        byte = std::uint8_t(random() >> 24);
    return bytes;
}

TEST(OpenVgCalls, RandomProgramsEnd) {
    constexpr unsigned programs = 600;
    std::size_t calls = 0;
    for (unsigned seed = 1; seed <= programs; ++seed)
        calls += vtm::fuzz::runOpenVgCalls(randomProgram(seed));
    EXPECT_GT(calls, 100'000u);
}

TEST(OpenVgCalls, BothCompositorsDrawRandomProgramsAlike) {
    constexpr unsigned programs = 300;
    std::size_t pixels = 0, different = 0;
    for (unsigned seed = 1; seed <= programs; ++seed) {
        const std::vector<std::uint8_t> bytes = randomProgram(seed);
        const auto cpu = vtm::fuzz::drawnByOpenVgCalls(bytes, VTM_COMPOSITOR_CPU),
                   gl = vtm::fuzz::drawnByOpenVgCalls(bytes, VTM_COMPOSITOR_GL);
        ASSERT_EQ(cpu.size(), gl.size());
        for (std::size_t i = 0; i < cpu.size(); ++i) {
            ASSERT_EQ(cpu[i].pixels.size(), gl[i].pixels.size());
            pixels += cpu[i].pixels.size();
            int largest = 0;
            for (std::size_t k = 0; k < cpu[i].pixels.size(); ++k) {
                const int d = std::abs(int(cpu[i].pixels[k]) - int(gl[i].pixels[k]));
                different += d > 1;
                largest = std::max(largest, d);
            }
            if (largest > 1)
                printf("seed %u surface %zu %dx%d bits %d%d%d%d%d lin %d pre %d: %d\n", seed, i, cpu[i].width, cpu[i].height, cpu[i].format.redBits, cpu[i].format.greenBits, cpu[i].format.blueBits, cpu[i].format.alphaBits, cpu[i].format.luminanceBits, cpu[i].format.linear, cpu[i].format.premultiplied, largest);
        }
    }
    printf("%zu of %zu\n", different, pixels);
}

}  // namespace

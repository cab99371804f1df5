#include "backend_gl/output/destination.hpp"

#include <array>
#include <random>

#include <gtest/gtest.h>

namespace vtm::gl {
namespace {

TEST(Boxes, BecomeDisjointAndKeepTheirPixels) {
    std::mt19937 random(8);
    for (int round = 0; round < 50; ++round) {
        std::vector<PixelBox> boxes;
        for (int i = 0; i < 9; ++i) {
            const glm::ivec2 corner(random() % 20, random() % 20);
            boxes.push_back({corner, corner + glm::ivec2(random() % 12, random() % 12)});
        }
        std::array<int, 32 * 32> wanted{}, got{};
        const auto mark = [](const PixelBox& box, std::array<int, 32 * 32>& in, bool count) {
            for (int y = box.min.y; y < box.max.y; ++y)
                for (int x = box.min.x; x < box.max.x; ++x) {
                    int& cell = in.at(std::size_t(y * 32 + x));
                    cell = count ? cell + 1 : 1;
                }
        };
        for (const PixelBox& box : boxes)
            mark(box, wanted, false);
        for (const PixelBox& box : disjoint(boxes))
            mark(box, got, true);
        EXPECT_EQ(got, wanted);
    }
}

}  // namespace
}  // namespace vtm::gl

// Rows of bytes: eight pixels at once beside pixel by pixel, which never is more than four at once.

#include "api/openvg/image/byte_rows.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vtm::openvg::testing {
namespace {

using Row = std::vector<std::uint8_t>;

class ByteRowsTest : public ::testing::Test {
protected:
    /// Of random bytes, many of them 0 or 255; premultiplied by the byte at `alpha` if it is one.
    Row row(int count, int alpha = -1) {
        Row bytes;
        for (int i = 0; i < 4 * count; ++i)
            bytes.push_back(std::uint8_t(random_() % 4 == 0 ? random_() % 2 * 255 : random_() % 256));
        if (alpha >= 0)
            for (std::size_t i = 0; i < bytes.size(); ++i)
                bytes[i] = std::min(bytes[i], bytes[i / 4 * 4 + std::size_t(alpha)]);
        return bytes;
    }
    /// `change` of a whole row, and of each of its pixels by itself: the same.
    template <class Change>
    void expectSame(const Row& before, Change&& change) {
        Row whole = before, single = before;
        const int count = int(before.size() / 4);
        change(whole, 0, count);
        for (int i = 0; i < count; ++i)
            change(single, i, 1);
        EXPECT_EQ(whole, single) << count << " pixels";
    }

    std::mt19937 random_{3};
};

TEST_F(ByteRowsTest, Colours) {
    for (int count = 0; count < 70; ++count)
        for (const bool keepsAlpha : {false, true}) {
            const float a = float(random_() % 256) / 255;
            const Color color(a * float(random_() % 256) / 255, 0.5f * a, a, a);
            expectSame(row(count, 3), [&](Row& bytes, int first, int size) {
                overBytes(bytes.data() + 4 * first, size, color, keepsAlpha);
            });
        }
}

TEST_F(ByteRowsTest, Pixels) {
    for (int count = 0; count < 70; ++count)
        for (const int alpha : {0, 3}) {
            const Row sources = row(count, alpha);
            expectSame(row(count, alpha), [&](Row& bytes, int first, int size) {
                overBytes(bytes.data() + 4 * first, sources.data() + 4 * first, size, alpha);
            });
        }
}

TEST_F(ByteRowsTest, Clamped) {
    for (int count = 0; count < 70; ++count)
        for (const int alpha : {0, 3}) {
            const Row given = row(count);
            Row taken(given.size());
            clampBytes(given.data(), taken.data(), count, alpha);
            for (std::size_t i = 0; i < given.size(); ++i)
                ASSERT_EQ(taken[i], std::min(given[i], given[i / 4 * 4 + std::size_t(alpha)]));
        }
}

TEST_F(ByteRowsTest, Premultiplied) {
    for (int count = 0; count < 70; ++count)
        for (const int alpha : {0, 3}) {
            const Row given = row(count);
            Row taken(given.size());
            premultiplyBytes(given.data(), taken.data(), count, alpha);
            for (std::size_t i = 0; i < given.size(); ++i) {
                const int a = given[i / 4 * 4 + std::size_t(alpha)];
                const bool isAlpha = int(i % 4) == alpha;
                ASSERT_EQ(taken[i], isAlpha ? a : (2 * given[i] * a + 255) / 510)
                    << int(given[i]) << ' ' << a;
            }
        }
}

TEST_F(ByteRowsTest, Moved) {
    constexpr int ways[][4] = {{0, 1, 2, 3}, {2, 1, 0, 3}, {3, 2, 1, -1}, {1, 2, 3, 0}, {-1, 0, 3, 1}};
    for (const auto& places : ways) {
        const Row given = row(64);
        Row taken = given;
        // Also in place.
        const int done = wide::moveBytes(taken.data(), taken.data(), 61, places, 0x30000001);
        ASSERT_TRUE(done == 0 || done == 56);
        for (int i = 0; i < 4 * done; ++i) {
            const int place = places[i % 4], added = i % 4 == 0 ? 1 : i % 4 == 3 ? 0x30 : 0;
            ASSERT_EQ(taken[std::size_t(i)], (place < 0 ? 0 : given[std::size_t(i / 4 * 4 + place)]) | added);
        }
        EXPECT_TRUE(std::equal(taken.begin() + 4 * done, taken.end(), given.begin() + 4 * done));
    }
}

}  // namespace
}  // namespace vtm::openvg::testing

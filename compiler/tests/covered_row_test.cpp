// What hides layers in dense pictures: a row of squares against every square asked for, and sorting by
// digits.

#include "compiler/direct/covered_row.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "compiler/containers/sort_places.hpp"

namespace vtm::compiler {
namespace {

constexpr std::int32_t columns = 300;

struct Layer {
    std::vector<Touch> touches;
    LayerCover cover;
    bool isEvenOdd;
};

Layer randomLayer(std::mt19937& random) {
    Layer layer{{}, {}, random() % 2 == 0};
    for (std::size_t pairs = 1 + random() % 3; pairs > 0; --pairs) {
        const auto touch = [&](std::int32_t winding) {
            const auto first = std::int32_t(random() % columns);
            layer.touches.push_back(
                {first, std::min(columns - 1, first + std::int32_t(random() % (random() % 2 == 0 ? 3 : 80))),
                 winding, random() % 4 == 0});
        };
        touch(1);
        touch(-1);
    }
    std::ranges::stable_sort(layer.touches, {}, &Touch::first);
    constexpr float alphas[]{0, 0.5f, 0.9f, 1};
    layer.cover = {alphas[random() % 4], random() % 3 == 0 ? std::uint32_t(random() % 2) : noIndex, true};
    return layer;
}

/// Of one layer in one square.
enum class Where { Outside, Inside, Touched };

Where whereIs(const Layer& layer, std::int32_t column) {
    std::int32_t winding = 0, firstEnd = columns, lastEnd = -1;
    for (const Touch& t : layer.touches)
        if (t.isEnd) {
            firstEnd = std::min(firstEnd, t.first);
            lastEnd = std::max(lastEnd, t.last);
        }
    if (firstEnd <= column && column <= lastEnd)
        return Where::Touched;
    for (const Touch& t : layer.touches) {
        if (t.first <= column && column <= t.last)
            return Where::Touched;
        winding += t.last < column ? t.winding : 0;
    }
    return (layer.isEvenOdd ? winding % 2 : winding) != 0 ? Where::Inside : Where::Outside;
}

TEST(CoveredRow, ShowsNothingBesideIt) {
    CoveredRow row(columns);
    const LayerCover opaque{1, noIndex, true};
    std::size_t steps = 1000;
    const std::vector<Touch> around{Touch::before(1, false), Touch::behind(columns, -1, false)};
    EXPECT_TRUE(row.add(around, opaque, false, steps));
    EXPECT_FALSE(row.add(around, opaque, false, steps));
    // What begins and ends on the left touches nothing; what begins there and ends in the row does.
    CoveredRow other(columns);
    EXPECT_FALSE(
        other.add(std::vector<Touch>{Touch::before(1, true), Touch::before(-1, true)}, opaque, false, steps));
    EXPECT_TRUE(
        other.add(std::vector<Touch>{Touch::before(1, true), {5, 5, -1, true}}, opaque, false, steps));
    EXPECT_TRUE(other.add(std::vector<Touch>{{0, 0, 1, false}, {1, 1, -1, false}}, opaque, false, steps));
}

TEST(CoveredRow, ShowsWhatAnySquareShows) {
    std::mt19937 random(3);
    int shown = 0, hidden = 0;
    for (int round = 0; round < 600; ++round) {
        CoveredRow row(columns);
        std::vector<float> light(columns, 1);
        std::vector<std::uint32_t> group(columns, noIndex);
        for (int l = 0; l < 60; ++l) {
            const Layer layer = randomLayer(random);
            bool shows = false;
            for (std::int32_t c = 0; c < columns; ++c) {
                const auto at = std::size_t(c);
                const Where where = whereIs(layer, c);
                shows |= where != Where::Outside && light[at] > unseen;
                if (where != Where::Inside || light[at] <= unseen || layer.cover.alpha <= 0 ||
                    (layer.cover.group != noIndex && layer.cover.group == group[at]))
                    continue;
                group[at] = layer.cover.group;
                light[at] *= 1 - layer.cover.alpha;
            }
            std::size_t steps = 1000;
            ASSERT_EQ(row.add(layer.touches, layer.cover, layer.isEvenOdd, steps), shows)
                << round << ' ' << l;
            ++(shows ? shown : hidden);
        }
    }
    EXPECT_GT(shown, 1000);
    EXPECT_GT(hidden, 1000);
}

TEST(CoveredRow, CoversNoMoreThanItsSteps) {
    CoveredRow row(columns);
    const std::vector<Touch> all{{0, 0, 1}, {columns - 1, columns - 1, -1}}, few{{5, 5, 1}, {7, 7, -1}};
    const LayerCover opaque{1, noIndex, true};
    std::size_t steps = 0;
    EXPECT_TRUE(row.add(all, opaque, false, steps));
    EXPECT_TRUE(row.add(few, opaque, false, steps));
    steps = columns;
    EXPECT_TRUE(row.add(all, opaque, false, steps));
    EXPECT_FALSE(row.add(few, opaque, false, steps));
    EXPECT_EQ(steps, columns - 5u);  // 300 squares are in five blocks
}

TEST(SortPlaces, SortsWhateverTheOrder) {
    std::mt19937 random(5);
    std::vector<Placed> spare;
    for (const std::size_t count : {0u, 1u, 2u, 50u, 3000u, 100000u})
        for (const float step : {0.001f, 1.0f, 1000.0f}) {
            std::vector<Placed> places;
            for (std::size_t i = 0; i < count; ++i)
                places.push_back({step * float(int(random() % 2000) - 700), std::uint32_t(i)});
            std::vector<Placed> expected = places;
            const auto isBefore = [](const Placed& a, const Placed& b) { return a.x < b.x; };
            std::ranges::stable_sort(expected, isBefore);
            sortPlaces(places, spare);
            for (std::size_t i = 0; i < count; ++i)
                ASSERT_EQ(places[i].x, expected[i].x) << count << ' ' << i;
            for (std::size_t i = 1; i < count; ++i)  // nearly in order
                places[i].x += random() % 64 == 0 ? 0.002f * step : 0;
            sortPlaces(places, spare);
            ASSERT_TRUE(std::ranges::is_sorted(places, isBefore)) << count;
            std::vector<bool> has(count);
            for (const Placed& p : places)
                has[p.number] = true;
            ASSERT_EQ(std::ranges::count(has, true), std::ptrdiff_t(count));
        }
}

}  // namespace
}  // namespace vtm::compiler

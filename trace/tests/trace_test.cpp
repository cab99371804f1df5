// What is drawn, traced and drawn again is what it was.

#include "trace/trace.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/reference/reference.hpp"

namespace vtm::trace {
namespace {

using scene::Path;
using scene::Scene;

constexpr int size = 128;

void addCircle(Path& path, double radius) {
    const scene::Point left{size / 2.0 - radius, size / 2.0}, right{size / 2.0 + radius, size / 2.0};
    path.push_back(scene::MoveTo{left});
    path.push_back(scene::ArcTo{{radius, radius}, 0, false, true, right});
    path.push_back(scene::ArcTo{{radius, radius}, 0, false, true, left});
    path.push_back(scene::Close{});
}

Path disc() {
    Path path;
    addCircle(path, 47.3);
    return path;
}

Path annulus() {
    Path path;
    addCircle(path, 55.7);
    addCircle(path, 30.2);
    return path;
}

/// A capital B: corners, curves, two holes.
Path glyph() {
    using scene::Close, scene::CubicTo, scene::LineTo, scene::MoveTo;
    return {MoveTo{{24.4, 12.3}},
            LineTo{{70, 12.3}},
            CubicTo{{104, 12.3}, {104, 60}, {76, 62}},
            CubicTo{{112, 64}, {112, 116.6}, {70, 116.6}},
            LineTo{{24.4, 116.6}},
            Close{},
            MoveTo{{42, 28}},
            LineTo{{42, 54}},
            LineTo{{66, 54}},
            CubicTo{{84, 54}, {84, 28}, {66, 28}},
            Close{},
            MoveTo{{42, 70}},
            LineTo{{42, 101}},
            LineTo{{68, 101}},
            CubicTo{{90, 101}, {90, 70}, {68, 70}},
            Close{}};
}

scene::Node itemOf(const Path& path, scene::Color color) {
    scene::Item item;
    item.path = std::make_shared<Path>(path);
    item.geometry = scene::FillRule::EvenOdd;
    item.paint = color;
    return {item};
}

Scene sceneOf(const Path& path) {
    Scene scene{size, size, {}};
    scene.root.children.push_back(itemOf(path, {0, 0, 0, 1}));
    return scene;
}

image::Raster draw(const Scene& scene) { return reference::render(scene, {size, size}); }

class Trace : public testing::Test {
protected:
    void SetUp() override {
        if (!available())
            GTEST_SKIP() << "built without potrace (VTM_WITH_POTRACE)";
    }
};

/// Coverage shared by both over coverage of either.
double overlap(const image::Raster& a, const image::Raster& b) {
    double both = 0, either = 0;
    for (std::size_t i = 3; i < a.rgba.size(); i += 4) {
        both += std::min(a.rgba[i], b.rgba[i]);
        either += std::max(a.rgba[i], b.rgba[i]);
    }
    return both / either;
}

/// Whether a pixel and its eight neighbours are all covered, or all not.
bool isFar(const image::Raster& raster, int x, int y) {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, size - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, size - 1); ++i)
            if (const float c = raster.pixel(i, j)[3];
                c != raster.pixel(x, y)[3] || (c > 1e-6 && c < 1 - 1e-6))
                return false;
    return true;
}

TEST_F(Trace, BringsShapesBackWithinAPixel) {
    for (const Path& path : {disc(), annulus(), glyph()}) {
        const image::Raster truth = draw(sceneOf(path));
        Options options;
        options.colors = 1;
        const image::Raster traced = draw(trace(image::toBitmap(truth), options));
        EXPECT_GE(overlap(traced, truth), 0.98);
        for (int i = 0; i < size * size; ++i) {
            const int x = i % size, y = i / size;
            const float tracedAlpha = traced.pixel(x, y)[3], alpha = truth.pixel(x, y)[3];
            ASSERT_TRUE(!isFar(truth, x, y) || std::abs(tracedAlpha - alpha) <= 1e-3f) << x << ", " << y;
        }
    }
}

TEST_F(Trace, StacksColoursWithoutGaps) {
    Scene scene{size, size, {}};
    scene.root.children = {itemOf(scene::rectangle({0, 0}, {size, size}), {1, 1, 1, 1}),
                           itemOf(disc(), {0, 0.4f, 0, 1}), itemOf(glyph(), {0.8f, 0.2f, 0.2f, 1})};
    const image::Raster truth = draw(scene);
    const Scene traced = trace(image::toBitmap(truth), {16, 2, 1});
    const image::Raster drawn = draw(traced);
    EXPECT_GE(traced.root.children.size(), 3u);
    for (std::size_t i = 3; i < drawn.rgba.size(); i += 4)
        ASSERT_NEAR(drawn.rgba[i], 1, 1e-3);
    for (const auto& [x, y] : {std::pair{4, 4}, {60, 85}, {33, 64}, {100, 64}, {30, 20}})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(drawn.pixel(x, y)[c], truth.pixel(x, y)[c], 1.0 / 16) << x << ", " << y;
}

TEST_F(Trace, LeavesSpecklesOut) {
    image::Bitmap bitmap{64, 64, std::vector<std::uint8_t>(64 * 64 * 4)};
    const auto set = [&](int x, int y) { bitmap.rgba[std::size_t(y * 64 + x) * 4 + 3] = 255; };
    set(5, 5), set(6, 5);
    for (int y = 20; y < 40; ++y)
        for (int x = 20; x < 40; ++x)
            set(x, y);
    const auto subpaths = [&](int speckle) {
        const Scene scene = trace(bitmap, {1, speckle, 1});
        return std::ranges::count_if(*std::get<scene::Item>(scene.root.children.at(0).value).path,
                                     [](const auto& c) { return std::holds_alternative<scene::MoveTo>(c); });
    };
    EXPECT_EQ(subpaths(0), 2);
    EXPECT_EQ(subpaths(2), 1);
}

TEST_F(Trace, OfNothingIsEmpty) {
    const Scene scene = trace(image::Bitmap{8, 4, std::vector<std::uint8_t>(8 * 4 * 4)});
    EXPECT_TRUE(scene.root.children.empty());
    EXPECT_EQ(scene.width, 8);
    EXPECT_EQ(scene.height, 4);
}

TEST_F(Trace, RefusesWhatIsOutOfRange) {
    const image::Bitmap bitmap{1, 1, {0, 0, 0, 255}};
    EXPECT_THROW(trace(image::Bitmap()), TraceError);
    EXPECT_THROW(trace(bitmap, {0, 2, 1}), TraceError);
    EXPECT_THROW(trace(bitmap, {257, 2, 1}), TraceError);
    EXPECT_THROW(trace(bitmap, {8, -1, 1}), TraceError);
    EXPECT_THROW(trace(bitmap, {8, 2, 1.5}), TraceError);
    EXPECT_THROW(trace(bitmap, {8, 2, std::nan("")}), TraceError);
}

TEST(TraceWithoutPotrace, SaysSo) {
    if (available())
        GTEST_SKIP() << "built with potrace";
    try {
        trace(image::Bitmap{1, 1, {0, 0, 0, 255}});
        FAIL();
    } catch (const TraceError& error) {
        EXPECT_NE(std::string(error.what()).find("VTM_WITH_POTRACE"), std::string::npos);
    }
}

}  // namespace
}  // namespace vtm::trace

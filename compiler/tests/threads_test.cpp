// What one thread makes of a scene, and what many make of it.

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vtm/asset/container.hpp>
#include <vtm/raster/evaluator.hpp>

namespace vtm::compiler {
namespace {

using scene::Point;

/// Blobs, some of them stroked, some in groups of their own, a few that repeat.
scene::Scene blobs(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    scene::Scene scene{100, 100, {}};
    std::shared_ptr<const scene::Path> last;
    for (int i = 0; i < count; ++i) {
        const Point centre(100 * uniform(random), 100 * uniform(random));
        const auto near = [&] { return centre + 4.0 * Point(uniform(random) - 0.5, uniform(random) - 0.5); };
        const Point start = near();
        scene::Path path{scene::MoveTo{start}, scene::CubicTo{near(), near(), near()},
                         scene::CubicTo{near(), near(), start}, scene::Close{}};
        scene::Item item;
        item.path = i % 9 == 8 ? last : std::make_shared<const scene::Path>(std::move(path));
        last = item.path;
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::Color{float(uniform(random)), 0.5f, float(i % 5) / 4, i % 3 == 0 ? 0.5f : 1.0f};
        scene::Group group;
        group.children.push_back({item});
        if (i % 4 == 0) {
            scene::StrokeStyle style;
            style.width = 0.2;
            item.geometry = style;
            group.children.push_back({item});
        }
        scene.root.children.push_back({std::move(group)});
    }
    return scene;
}

/// Stars with round points, of so many kinds, each in many places.
scene::Scene stars(int kinds) {
    std::vector<std::shared_ptr<const scene::Path>> paths;
    for (int points = 5; points < 5 + kinds; ++points) {
        const auto at = [&](double turn, double radius) {
            return radius * Point(std::cos(turn), std::sin(turn));
        };
        scene::Path path{scene::MoveTo{at(0, 1)}};
        const double turn = 2 * std::numbers::pi / points;
        for (int i = 0; i < points; ++i)
            path.push_back(
                scene::CubicTo{at((i + 0.2) * turn, 0.3), at((i + 0.8) * turn, 0.4), at((i + 1) * turn, 1)});
        path.push_back(scene::Close{});
        paths.push_back(std::make_shared<const scene::Path>(std::move(path)));
    }
    std::mt19937 random(3);
    scene::Scene scene{100, 100, {}};
    for (int i = 0; i < 1600; ++i) {
        scene::Item item;
        item.path = paths[random() % paths.size()];
        item.transform = scene::translation(1.25 + 2.45 * (i % 40), 1.25 + 2.45 * double(i / 40));
        item.paint = scene::Color{float(i % 3) / 2, 0, 0, 1};
        scene.root.children.push_back({std::move(item)});
    }
    return scene;
}

/// Groups with filters, which are drawn at once, some of them in each other.
scene::Scene filtered() {
    scene::Scene scene{100, 100, {}};
    for (int i = 0; i < 12; ++i) {
        scene::Group group = blobs(20 + i).root;
        const scene::FilterPrimitive blur{
            scene::GaussianBlurFilter{0.3f * float(i % 4), 0.5f}, {{}}, {-10, -10}, {110, 110}, i % 2 == 0};
        group.filter =
            std::make_shared<scene::Filter>(scene::Filter{scene::identity, {-10, -10}, {110, 110}, {blur}});
        group.opacity = 0.8f;
        scene.root.children.push_back({group});
        scene::Group outer;
        outer.children = {{group}, {blobs(10).root}, {group}};
        outer.blend = i % 3 == 0 ? scene::BlendMode::Multiply : scene::BlendMode::Normal;
        scene.root.children.push_back({std::move(outer)});
    }
    return scene;
}

/// Rectangles of a gradient, multiplied.
scene::Scene blendedGradients(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-4, 100), size(1, 12);
    scene::Scene scene{100, 100, {}};
    for (int i = 0; i < count; ++i) {
        const Point from(place(random), place(random)), to = from + Point(size(random), size(random));
        scene::Item item;
        item.path = std::make_shared<const scene::Path>(
            scene::Path{scene::MoveTo{from}, scene::LineTo{{to.x, from.y}}, scene::LineTo{to},
                        scene::LineTo{{from.x, to.y}}, scene::Close{}});
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::LinearGradient{from, to, {{0, {1, 0.2f, 0.2f, 0.5f}}, {1, {0.2f, 0.2f, 1, 1}}}};
        scene::Group group;
        group.blend = scene::BlendMode::Multiply;
        group.children.push_back({item});
        scene.root.children.push_back({std::move(group)});
    }
    return scene;
}

template <class Make>
auto madeBy(int threads, const Make& make) {
    decltype(make()) made;
    tbb::task_arena(threads).execute([&] { made = make(); });
    return made;
}

TEST(Threads, CompileToTheSameBytes) {
    const scene::Scene scene = blobs(1500);
    for (const asset::Mode mode : {asset::Mode::Exact, asset::Mode::Compat}) {
        Options options;
        options.mode = mode;
        const auto bytes = [&] { return asset::write(compile(scene, options).asset); };
        EXPECT_EQ(madeBy(1, bytes), madeBy(5, bytes));
    }
}

TEST(Threads, CompileRepeatsToTheSameBytes) {
    const scene::Scene scene = stars(30);
    const auto bytes = [&] { return asset::write(compile(scene).asset); };
    EXPECT_EQ(madeBy(1, bytes), madeBy(5, bytes));
    EXPECT_GE(compile(scene).asset.symbols.size(), 30u);
}

TEST(Threads, DrawTheSameFilters) {
    const scene::Scene scene = filtered();
    asset::View view{500, 500, {}};
    view.toPixels = {5, 0.3, -0.3, 5, 0, 0};
    const auto once = [&] {
        std::vector<std::uint8_t> pixels(500 * 500 * 4);
        ViewDrawing::make(scene, view)->draw({pixels.data(), 500 * 4});
        return pixels;
    };
    EXPECT_EQ(madeBy(1, once), madeBy(5, once));
    const asset::Asset asset = compile(scene).asset;
    const auto again = [&] {
        std::vector<std::uint8_t> pixels(500 * 500 * 4);
        asset::Evaluator(asset).draw(view, {pixels.data(), 500 * 4});
        return pixels;
    };
    EXPECT_EQ(madeBy(1, again), madeBy(5, again));
}

TEST(Threads, DrawTheSameView) {
    const scene::Scene scene = blobs(3000);
    asset::View view{400, 400, {}};
    view.toPixels = {4, 0, 0, 4, 0, 0};
    const auto bytes = [&] {
        std::vector<std::uint8_t> pixels(400 * 400 * 4);
        ViewDrawing::make(scene, view)->draw({pixels.data(), 400 * 4});
        return pixels;
    };
    EXPECT_EQ(madeBy(1, bytes), madeBy(5, bytes));
}

/// How many programs a strip remembers tells how the rest of it is drawn.
TEST(Threads, DrawStripsOfManyProgramsTheSame) {
    constexpr int side = 200, strip = 64;
    const scene::Scene scene = blendedGradients(1500);
    asset::View view{side, side, {}};
    view.toPixels = {2, 0, 0, 2, 0, 0};
    const auto drawing = ViewDrawing::make(scene, view);
    const image::Raster all = madeBy(1, [&] { return drawing->draw(); });
    for (int first = 0; first < side; first += strip)
        drawing->scan(first, std::min(first + strip, side), [&](int y, const asset::ColorRun& run) {
            for (int x = run.first; x < run.end; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(all.pixel(x, y)[c], std::clamp(run.color[c], 0.0f, 1.0f)) << x << ", " << y;
        });
}

}  // namespace
}  // namespace vtm::compiler

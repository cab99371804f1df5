// What one thread makes of a scene, and what many make of it.

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <vtm/asset/container.hpp>

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

}  // namespace
}  // namespace vtm::compiler

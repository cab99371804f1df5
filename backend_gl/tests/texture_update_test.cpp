// Textures that follow the edits of a session.

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/session.hpp>
#include <vtm/gl/renderer.hpp>
#include "backend_gl/tests/gl_fixture.hpp"

namespace vtm::gl {
namespace {

using asset::View;
using compiler::Session;

double largestDifference(const image::Raster& a, const image::Raster& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        largest = std::max(largest, std::abs(double(a.rgba[i]) - double(b.rgba[i])));
    return largest;
}

/// Of a picture of 64 × 64 units.
View view(int size, double scale, double shear) {
    return {size, size, {scale, shear * scale, -shear * scale, scale, 3.3, 1.7}};
}

/// Some squares in rows, all of them drawn.
scene::Scene squares(int count) {
    scene::Scene scene;
    scene.width = scene.height = 64;
    for (int i = 0; i < count; ++i) {
        const double x = 2 + i % 15 * 4, y = 2 + i / 15 * 4;
        scene::Item item;
        item.path = std::make_shared<scene::Path>(
            scene::polygon({{x, y}, {x + 3, y + 0.3}, {x + 2.7, y + 3}, {x + 0.2, y + 2.8}}));
        item.paint = scene::Color{0.2f, 0.1f + 0.003f * float(i), 0.9f, 1};
        scene.root.children.push_back({std::move(item)});
    }
    return scene;
}

/// Tiles that are kept are cut from pieces with which they once were made, of a level of detail.
constexpr double apart = 1.0 / 255;

/// Recolours, moves, adds and removes items at random; some become gradients.
class Editor {
public:
    Editor(unsigned seed, int items) : scene(squares(items)), random_(seed) {}

    std::string edit() {
        scene::NodeList& items = scene.root.children;
        const std::size_t at = random_() % items.size();
        auto& item = std::get<scene::Item>(items[at].value);
        switch (random_() % 5) {
            case 0:
                item.paint = color();
                return "recolour";
            case 1:
                item.transform[2] += scene::Point(share() * 20 - 10, share() * 20 - 10);
                return "move";
            case 2: {
                scene::LinearGradient gradient;
                gradient.end = {1, 1};
                gradient.stops = {{0, color()}, {1, color()}};
                item.paint = gradient;
                return "gradient";
            }
            case 3: {
                scene::Item added = item;
                added.transform[2] += scene::Point(5, 5);
                added.paint = color();
                items.insert(items.begin() + std::ptrdiff_t(at), {std::move(added)});
                return "add";
            }
            default:
                items.erase(items.begin() + std::ptrdiff_t(at));
                return "remove";
        }
    }

    scene::Scene scene;

private:
    double share() { return std::uniform_real_distribution<double>()(random_); }
    scene::Color color() { return {float(share()), float(share()), float(share()), float(share())}; }

    std::mt19937 random_;
};

class UpdatedTextures : public Gl, public testing::WithParamInterface<std::tuple<unsigned, int>> {};
INSTANTIATE_TEST_SUITE_P(SeedAndItems, UpdatedTextures,
                         testing::Combine(testing::Range(0u, 3u), testing::Values(12, 200)));

TEST_P(UpdatedTextures, ShowWhatNewOnesDo) {
    const auto [seed, items] = GetParam();
    Editor editor(seed, items);
    Session session(editor.scene);
    Texture texture = renderer->upload(session.result().asset);
    const View views[]{view(100, 1.3, 0), view(60, 0.7, 0.4), view(12, 0.15, -0.1)};
    std::string history;
    for (int step = 0; step < 10; ++step) {
        for (const View& v : views)
            renderer->render(texture, v);  // makes tiles
        history += editor.edit() + ", ";
        session.update(editor.scene);
        texture.update(session.result().asset, session.difference());
        const Texture fresh = renderer->upload(session.result().asset);
        for (const View& v : views)
            ASSERT_LE(largestDifference(renderer->render(texture, v), renderer->render(fresh, v)), apart)
                << history << "at " << v.width << " pixels";
    }
}

TEST_F(Gl, RecolouringSendsLittle) {
    scene::Scene scene = squares(200);
    Session session(scene);
    Texture texture = renderer->upload(session.result().asset);
    renderer->render(texture, view(900, 14, 0));
    const auto recolour = [&](float red) {
        std::get<scene::Item>(scene.root.children[0].value).paint = scene::Color{red, 0.5f, 0, 1};
        session.update(scene);
        return texture.update(session.result().asset, session.difference());
    };
    recolour(0.5f);  // keeps what it sends
    EXPECT_GT(recolour(0.8f), 0u);
    EXPECT_LT(recolour(0.9f), 100'000u);
    const Texture fresh = renderer->upload(session.result().asset);
    EXPECT_EQ(largestDifference(renderer->render(texture, view(900, 14, 0)),
                                renderer->render(fresh, view(900, 14, 0))),
              0);
}

// ---- Zooms, whose next tiles are made on a thread -------------------------------------------------------

/// A zoom in and out again, over three levels, by 9 frames an octave.
std::vector<View> zoom() {
    std::vector<View> views;
    for (int frame = 0; frame <= 54; ++frame)
        views.push_back(view(90, 1.1 * std::exp2((27 - std::abs(27 - frame)) / 9.0), 0.2));
    return views;
}

TEST_F(Gl, FramesOfAZoomAreThoseOfNewTextures) {
    const asset::Asset asset = compiler::compile(squares(200)).asset;
    Texture zoomed = renderer->upload(asset);
    for (const View& v : zoom())
        ASSERT_EQ(renderer->render(zoomed, v).rgba, renderer->render(renderer->upload(asset), v).rgba)
            << v.toPixels[0].x;
}

TEST_F(Gl, ZoomsGoOnThroughEdits) {
    Editor editor(7, 200);
    Session session(editor.scene);
    Texture texture = renderer->upload(session.result().asset);
    int frame = 0;
    for (const View& v : zoom()) {
        const image::Raster drawn = renderer->render(texture, v);
        if (frame++ % 3 != 0)
            continue;
        EXPECT_LE(largestDifference(drawn, renderer->render(renderer->upload(session.result().asset), v)),
                  apart)
            << frame;
        editor.edit();
        session.update(editor.scene);
        texture.update(session.result().asset, session.difference());
    }
}

/// Whatever its thread is at.
TEST_F(Gl, TexturesMayGoAmidAZoom) {
    const asset::Asset asset = compiler::compile(squares(200)).asset;
    const std::vector<View> views = zoom();
    for (std::size_t frames = 1; frames < views.size(); ++frames) {
        const Texture texture = renderer->upload(asset);
        for (std::size_t i = frames > 12 ? frames - 12 : 0; i < frames; ++i)
            renderer->render(texture, views[i]);
    }
}

}  // namespace
}  // namespace vtm::gl

// What a session says has changed, as the scanner takes it: a picture that is kept up to date.

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include <vtm/compiler/session.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "compiler/tests/random_edits.hpp"

namespace vtm::compiler {
namespace {

struct Bytes {
    explicit Bytes(const asset::View& view)
        : rowBytes(std::size_t(view.width) * 4), pixels(rowBytes * std::size_t(view.height)) {}
    asset::ByteTarget target() { return {pixels.data(), rowBytes}; }

    std::size_t rowBytes;
    std::vector<std::uint8_t> pixels;
};

int largestDifference(const Bytes& a, const Bytes& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(int(a.pixels[i]) - int(b.pixels[i])));
    return largest;
}

/// Returns how many pixels were drawn.
template <class Engine>
std::size_t drawChanges(const Engine& engine, const Session& session, const asset::View& view, Bytes& bytes) {
    std::size_t pixels = 0;
    for (const asset::PixelBox& box : asset::changedPixels(view, session.difference())) {
        engine.drawBox(view, box, bytes.target());
        pixels += box.area();
    }
    return pixels;
}

/// Keeps a scanner and a picture, as a program does that shows what is edited.
class Shown {
public:
    Shown(const Session& session, const asset::View& view)
        : view_(view), scanner_(session.result().asset), bytes_(view) {
        scanner_.draw(view_, bytes_.target());
    }

    /// Returns how many pixels were drawn.
    std::size_t update(const Session& session) {
        scanner_.update(session.result().asset, session.difference());
        return drawChanges(scanner_, session, view_, bytes_);
    }

    /// The picture, and what its scanner draws as a whole, are those of a new scanner.
    void expectFresh(const Session& session) const {
        Bytes fresh(view_), whole(view_);
        asset::Scanner(session.result().asset).draw(view_, fresh.target());
        scanner_.draw(view_, whole.target());
        EXPECT_LE(largestDifference(whole, fresh), 1);
        EXPECT_LE(largestDifference(bytes_, fresh), 1);
    }

private:
    asset::View view_;
    asset::Scanner scanner_;
    Bytes bytes_;
};

/// The same of pictures with filters, by an evaluator.
class ShownByEvaluator {
public:
    ShownByEvaluator(const Session& session, const asset::View& view)
        : view_(view), evaluator_(session.result().asset), bytes_(view) {
        evaluator_.draw(view_, bytes_.target());
    }

    /// Returns how many pixels were drawn.
    std::size_t update(const Session& session) {
        evaluator_.update(session.result().asset, session.difference());
        return drawChanges(evaluator_, session, view_, bytes_);
    }

    void expectFresh(const Session& session) const {
        Bytes fresh(view_), whole(view_);
        asset::Evaluator(session.result().asset).draw(view_, fresh.target());
        evaluator_.draw(view_, whole.target());
        EXPECT_LE(largestDifference(whole, fresh), 1);
        // Of three blurs after each other, each within 1/255, what is drawn may end elsewhere.
        EXPECT_LE(largestDifference(bytes_, fresh), 2);
    }
    void expectFresh(const scene::Scene& scene) const {
        Bytes fresh(view_);
        const asset::Asset asset = compile(scene).asset;
        asset::Evaluator(asset).draw(view_, fresh.target());
        EXPECT_LE(largestDifference(bytes_, fresh), 2);
    }

private:
    asset::View view_;
    asset::Evaluator evaluator_;
    Bytes bytes_;
};

/// Of a picture of 64 × 64 units.
asset::View view(int size, double scale, double shear) {
    return {size, size, {scale, shear * scale, -shear * scale, scale, 3.3, 1.7}};
}

/// Random edits, in pictures that are kept up to date.
template <class Kept>
void expectShown(test::RandomEditor editor) {
    Session session(editor.scene());
    Kept upright(session, view(100, 1.3, 0)), turned(session, view(60, 0.7, 0.4)),
        small(session, view(12, 0.15, -0.1));
    std::string history;
    for (int i = 0; i < 25 && !testing::Test::HasFailure(); ++i) {
        history += editor.edit() + ", ";
        session.update(editor.scene());
        for (Kept* shown : {&upright, &turned, &small}) {
            shown->update(session);
            shown->expectFresh(session);
        }
    }
    EXPECT_FALSE(testing::Test::HasFailure()) << history;
}

class ShownEdits : public testing::TestWithParam<std::tuple<unsigned, int>> {};
INSTANTIATE_TEST_SUITE_P(SeedAndItems, ShownEdits,
                         testing::Combine(testing::Range(0u, 4u), testing::Values(6, 60)));

TEST_P(ShownEdits, AreDrawnWhereTheyAre) {
    const auto [seed, items] = GetParam();
    expectShown<Shown>({seed, items});
}

class ShownFilters : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seed, ShownFilters, testing::Range(0u, 8u));

TEST_P(ShownFilters, AreDrawnWhereTheyAre) {
    expectShown<ShownByEvaluator>({GetParam(), 30, test::RandomEditor::Filters::Some});
}

scene::Item square(scene::Point at, float red) {
    scene::Item item;
    item.path = std::make_shared<scene::Path>(scene::rectangle(at, at + scene::Point{0.6, 0.6}));
    item.transform = {1, 0.1, -0.1, 1, 0, 0};
    item.paint = scene::Color{red, 0, 0, 1};
    return item;
}

scene::Scene squares(int perSide) {
    scene::Scene scene{double(perSide), double(perSide), {}};
    for (int i = 0; i < perSide * perSide; ++i)
        scene.root.children.push_back({square({double(i % perSide), double(i / perSide)}, 1)});
    return scene;
}

/// The item's outline stays, and its paint's record stays where it is.
TEST(ShownSession, RedrawsWhatChangesInAPaint) {
    const auto bitmap = [](std::uint8_t red) {
        return std::make_shared<image::Bitmap>(image::Bitmap{1, 1, {red, 0, 0, 255}});
    };
    const scene::Color red{1, 0, 0, 1}, blue{0, 0, 1, 1};
    const std::vector<std::pair<scene::Paint, scene::Paint>> paints{
        {scene::LinearGradient{{0, 0}, {40, 40}, {{0, red}, {1, red}}},
         scene::LinearGradient{{0, 0}, {40, 40}, {{0, red}, {1, blue}}}},
        {scene::RadialGradient{{20, 20}, 30, {20, 20}, 0, {{0, red}, {1, red}}},
         scene::RadialGradient{{20, 20}, 30, {20, 20}, 0, {{0, red}, {1, blue}}}},
        {scene::ImagePaint{bitmap(255)}, scene::ImagePaint{bitmap(0)}},
        {scene::Material{"stone", "vec4 stone(vec2 p) { return vec4(1.0); }", red},
         scene::Material{"stone", "vec4 stone(vec2 p) { return vec4(1.0); }", blue}}};
    for (const auto& [before, after] : paints) {
        scene::Scene scene = squares(4);
        scene::Paint& paint = std::get<scene::Item>(scene.root.children[5].value).paint;
        paint = before;
        Session session(scene);
        Shown shown(session, {40, 40, {10, 0, 0, 10, 0, 0}});
        paint = after;
        session.update(scene);
        EXPECT_FALSE(session.difference().areas.empty()) << before.index();
        shown.update(session);
        shown.expectFresh(session);
    }
}

/// A square of a picture of 40 × 40 is moved under a blur of half a unit, whose light ends within 4 units.
TEST(ShownSession, RedrawsAsFarAsABlurSpreads) {
    scene::Group blurred;
    blurred.children.push_back({square({20, 20}, 1)});
    const scene::FilterPrimitive blur{
        scene::GaussianBlurFilter{0.5f, 0.5f}, {{}}, {-10, -10}, {50, 50}, false};
    blurred.filter =
        std::make_shared<scene::Filter>(scene::Filter{scene::identity, {-10, -10}, {50, 50}, {blur}});
    scene::Scene scene = squares(40);
    scene.root.children.push_back({blurred});
    Session session(scene);
    ShownByEvaluator shown(session, {400, 400, {10, 0, 0, 10, 0, 0}});
    auto& moved = std::get<scene::Group>(scene.root.children.back().value).children[0];
    std::get<scene::Item>(moved.value).transform = scene::translation(3, 2);
    session.update(scene);
    EXPECT_EQ(session.lastUpdate().blocks, 1u);
    EXPECT_LT(shown.update(session), 12000u);
    shown.expectFresh(session);
}

TEST(ShownSession, RedrawsLittleForASmallItem) {
    scene::Scene scene = squares(40);
    Session session(scene);
    Shown shown(session, {400, 400, {10, 0, 0, 10, 0, 0}});
    scene::Item& item = std::get<scene::Item>(scene.root.children[777].value);
    item.paint = scene::Color{0, 1, 0, 1};
    session.update(scene);
    EXPECT_FALSE(session.difference().everything);
    EXPECT_TRUE(session.difference().squares.empty());
    const std::size_t recoloured = shown.update(session);
    EXPECT_GT(recoloured, 50u);
    EXPECT_LT(recoloured, 4000u);
    shown.expectFresh(session);
    item.transform = scene::translation(0.2, 0.3);
    session.update(scene);
    EXPECT_FALSE(session.difference().squares.empty());
    EXPECT_LT(shown.update(session), 8000u);
    shown.expectFresh(session);
    session.update(scene);
    EXPECT_EQ(shown.update(session), 0u);
}

TEST(ShownSession, MovingEverythingIsCompiledWithoutBlocks) {
    scene::Scene scene = squares(20);
    Session session(scene);
    Shown shown(session, {200, 200, {10, 0, 0, 10, 0, 0}});
    for (int frame = 1; frame < 4; ++frame) {
        for (scene::Node& node : scene.root.children)
            std::get<scene::Item>(node.value).transform = scene::translation(0.01 * frame, 0);
        session.update(scene);
        EXPECT_TRUE(session.lastUpdate().anew);
        EXPECT_EQ(session.lastUpdate().blocksInAll, 0u);
        EXPECT_EQ(shown.update(session), 200u * 200u);
        shown.expectFresh(session);
    }
    for (int i = 0; i < 3; ++i) {  // little changes again: blocks are made once, and of use then
        std::get<scene::Item>(scene.root.children[5].value).transform = scene::translation(0.01 * i, 0.2);
        session.update(scene);
        EXPECT_EQ(session.lastUpdate().anew, i == 0);
        shown.update(session);
        shown.expectFresh(session);
    }
}

TEST(ShownSession, AScannerOfAnotherAssetIsRefused) {
    const asset::Asset asset = compile(squares(2)).asset;
    asset::Scanner scanner(asset);
    asset::Asset other = asset;
    other.maps.push_back(other.maps[0]);
    asset::Difference little;
    little.everything = false;
    EXPECT_THROW(scanner.update(other, little), std::invalid_argument);
    EXPECT_NO_THROW(scanner.update(other, {}));
}

}  // namespace
}  // namespace vtm::compiler

#include <vtm/compiler/session.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include <vtm/asset/container.hpp>
#include "compiler/tests/comparison.hpp"
#include "compiler/tests/random_edits.hpp"

namespace vtm::compiler {
namespace {

using scene::Color;
using scene::Group;
using scene::Item;
using scene::Point;
using scene::Scene;

void expectFresh(const Session& session, const Scene& scene, const Options& options = {}) {
    ASSERT_NO_THROW(asset::validate(session.result().asset));
    const asset::Asset fresh = compile(scene, options).asset;
    test::Comparison(session.result().asset, fresh, options.tolerance).run();
    EXPECT_EQ(session.result().asset.fallbackLeaves, fresh.fallbackLeaves);
}

// ---- random edits -------------------------------------------------------------------------------

/// A seed, and how many items the scene starts with: few in one block, many in several.
class RandomEdits : public testing::TestWithParam<std::tuple<unsigned, int>> {};
INSTANTIATE_TEST_SUITE_P(SeedAndItems, RandomEdits,
                         testing::Combine(testing::Range(0u, 5u), testing::Values(6, 60)));

TEST_P(RandomEdits, drawWhatAFreshCompilationDraws) {
    const auto [seed, items] = GetParam();
    test::RandomEditor editor(seed, items);
    Session session(editor.scene());
    expectFresh(session, editor.scene());
    std::string history;
    int anew = 0;
    for (int i = 0; i < 50 && !HasFailure(); ++i) {
        history += editor.edit() + ", ";
        session.update(editor.scene());
        anew += session.lastUpdate().anew;
        expectFresh(session, editor.scene());
    }
    EXPECT_LE(anew, 3);  // when the picture has become much larger or smaller
    EXPECT_FALSE(HasFailure()) << history;
}

class FilteredEdits : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seed, FilteredEdits, testing::Range(0u, 8u));

/// Of a picture of 64 × 64 units, by 255ths.
double largestDifference(const asset::Asset& a, const asset::Asset& b) {
    const asset::View view{100, 100, {1.5, 0.1, -0.1, 1.5, 3, 2}};
    const image::Raster p = asset::evaluate(a, view), q = asset::evaluate(b, view);
    float largest = 0;
    for (std::size_t i = 0; i < p.rgba.size(); ++i)
        largest = std::max(largest, std::abs(p.rgba[i] - q.rgba[i]));
    return 255 * double(largest);
}

/// The parts between filters are kept, or edited in some of their squares.
TEST_P(FilteredEdits, drawWhatAFreshCompilationDraws) {
    test::RandomEditor editor(GetParam(), 30, test::RandomEditor::Filters::Some);
    Session session(editor.scene());
    std::size_t filtered = 0, kept = 0, edited = 0;
    std::string history;
    for (int i = 0; i < 60; ++i) {
        history += editor.edit() + ", ";
        session.update(editor.scene());
        const asset::Asset& asset = session.result().asset;
        if (asset.filters.empty())
            continue;
        ++filtered;
        kept += session.lastUpdate().blocksInAll - session.lastUpdate().blocks;
        for (const asset::MapChange& map : session.difference().maps)
            edited += map.before != asset::MapChange::isNew && !map.squares.empty();
        ASSERT_NO_THROW(asset::validate(asset));
        ASSERT_LE(largestDifference(asset, compile(editor.scene()).asset), 2) << history;
    }
    EXPECT_GT(filtered, 5u);
    EXPECT_GT(kept, filtered);
    EXPECT_GT(edited, 0u);
}

/// They cannot be geometry of blocks.
TEST(Session, keepsPatternsOfTooManyTiles) {
    Group tile;
    Item dot;
    dot.path = std::make_shared<scene::Path>(scene::rectangle({0, 0}, {0.2, 0.1}));
    dot.paint = Color{1, 0, 0, 1};
    tile.children.push_back({dot});
    Item ground;
    ground.path = std::make_shared<scene::Path>(scene::rectangle({2, 3}, {60, 61}));
    ground.paint = scene::Pattern{{0, 0}, {0.3, 0.3}, std::make_shared<Group>(std::move(tile))};
    Scene scene{64, 64, {}};
    scene.root.children.push_back({ground});
    scene.root.children.push_back({dot});
    Session session(scene);
    for (const double by : {0.0, 5.0, 9.0}) {
        std::get<Item>(scene.root.children[1].value).transform = scene::translation(by, 0);
        session.update(scene);
        const Result fresh = compile(scene);
        EXPECT_EQ(session.result().warnings, fresh.warnings);
        EXPECT_LE(largestDifference(session.result().asset, fresh.asset), 2);
    }
}

/// A blurred square between squares with an image each.
Scene imagesAndABlur() {
    Scene scene{64, 64, {}};
    const auto square = [](Point at) {
        Item item;
        item.path = std::make_shared<scene::Path>(scene::rectangle(at, at + Point{20, 20}));
        return item;
    };
    for (int i = 0; i < 3; ++i) {
        Item item = square({8.0 + 10 * i, 8.0 + 10 * i});
        if (i == 1) {
            item.paint = Color{1, 0, 0, 1};
            Group blurred;
            const Point min(-10), max(74);
            blurred.filter = std::make_shared<scene::Filter>(scene::Filter{
                scene::identity, min, max, {{scene::GaussianBlurFilter{1, 1}, {{}}, min, max, false}}});
            blurred.children.push_back({item});
            scene.root.children.push_back({blurred});
        } else {
            item.paint = scene::ImagePaint{
                std::make_shared<image::Bitmap>(image::Bitmap{1, 1, {std::uint8_t(100 * i), 50, 20, 255}})};
            scene.root.children.push_back({item});
        }
    }
    return scene;
}

TEST(Session, tellsWhetherImagesBetweenFiltersStayed) {
    Scene scene = imagesAndABlur();
    Session session(scene);
    EXPECT_TRUE(session.difference().images);
    auto& blurred = std::get<Group>(scene.root.children[1].value);
    std::get<Item>(blurred.children[0].value).paint = Color{0, 1, 0, 1};
    session.update(scene);
    EXPECT_FALSE(session.difference().images);
    std::swap(scene.root.children[0], scene.root.children[2]);
    session.update(scene);
    EXPECT_TRUE(session.difference().images);
    session.update(scene);
    EXPECT_FALSE(session.difference().images);
    std::get<Item>(scene.root.children[0].value).paint = Color{0, 0, 1, 1};
    session.update(scene);
    EXPECT_TRUE(session.difference().images);
}

TEST(Session, givesTheSameBytesForTheSameEdits) {
    const auto bytes = [] {
        test::RandomEditor editor(99, 60);
        Session session(editor.scene());
        for (int i = 0; i < 20; ++i) {
            editor.edit();
            session.update(editor.scene());
        }
        return asset::write(session.result().asset);
    };
    EXPECT_EQ(bytes(), bytes());
}

// ---- what an edit costs -------------------------------------------------------------------------

constexpr int columns = 24;

Item tile(int i, Color color) {
    Item item;
    const Point at{double(i % columns), double(i / columns)};
    item.path = std::make_shared<scene::Path>(
        scene::Path{scene::MoveTo{at}, scene::LineTo{at + Point{0.7, 0.1}},
                    scene::QuadTo{at + Point{1.1, 0.6}, at + Point{0.3, 0.8}}, scene::Close{}});
    item.paint = color;
    return item;
}

/// Small items in rows, over a large one.
Scene tiles() {
    Scene scene{columns, columns, {}};
    Item ground;
    ground.path = std::make_shared<scene::Path>(scene::rectangle({0, 0}, {columns, columns}));
    ground.paint = Color{1, 1, 1, 1};
    scene.root.children.push_back({ground});
    for (int i = 0; i < columns * columns; ++i)
        scene.root.children.push_back({tile(i, {0.5f, 0, 0, 1})});
    return scene;
}

Item& itemOf(Scene& scene, std::size_t child) { return std::get<Item>(scene.root.children[child].value); }

class EditedTiles : public testing::Test {
protected:
    Scene scene_ = tiles();
    Session session_{scene_};

    const Update& update() {
        session_.update(scene_);
        expectFresh(session_, scene_);
        return session_.lastUpdate();
    }
};

TEST_F(EditedTiles, areDividedIntoManyBlocks) {
    EXPECT_TRUE(session_.lastUpdate().anew);
    EXPECT_EQ(session_.lastUpdate().outlines, columns * columns + 1u);
    EXPECT_EQ(session_.lastUpdate().blocks, session_.lastUpdate().blocksInAll);
    EXPECT_GE(session_.lastUpdate().blocksInAll, 16u);
}

TEST_F(EditedTiles, recolouringTouchesNoGeometry) {
    const auto pieces = session_.result().asset.pieces;
    for (std::size_t child : {0, 1, 300}) {
        itemOf(scene_, child).paint = Color{0, 0, 1, 1};
        const Update& update = this->update();
        EXPECT_FALSE(update.anew);
        EXPECT_EQ(update.outlines, 0u);
        EXPECT_EQ(update.blocks, 0u);
        EXPECT_EQ(update.paints, 1u);
    }
    EXPECT_TRUE(std::equal(pieces.begin(), pieces.end(), session_.result().asset.pieces.begin(),
                           session_.result().asset.pieces.end(), [](const auto& a, const auto& b) {
                               return a.a == b.a && a.b == b.b && a.left == b.left && a.right == b.right;
                           }));
}

TEST_F(EditedTiles, repaintingWithAGradientTouchesNoGeometry) {
    itemOf(scene_, 40).paint =
        scene::LinearGradient{{0, 0}, {columns, columns}, {{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 1}}}};
    EXPECT_EQ(update().blocks, 0u);
    itemOf(scene_, 40).paint =
        scene::LinearGradient{{0, 0}, {columns, columns}, {{0, {1, 0, 0, 1}}, {1, {0, 1, 0, 1}}}};
    EXPECT_EQ(update().blocks, 0u);
    itemOf(scene_, 40).paint = Color{0, 1, 0, 1};
    EXPECT_EQ(update().blocks, 0u);
}

TEST_F(EditedTiles, fadingBuildsBlocksOnlyWhenTheItemCeasesToHideWhatIsBelow) {
    itemOf(scene_, 100).opacity = 0.9f;
    EXPECT_GT(update().blocks, 0u);
    itemOf(scene_, 100).opacity = 0.8f;
    EXPECT_EQ(update().blocks, 0u);
}

TEST_F(EditedTiles, movingASmallItemBuildsTheBlocksItLeavesAndEnters) {
    Item& item = itemOf(scene_, 200);
    item.transform = scene::translation(0.3, 0.2);
    const Update& update = this->update();
    EXPECT_EQ(update.outlines, 1u);
    EXPECT_GE(update.blocks, 1u);
    EXPECT_LE(update.blocks, 4u);
    item.transform = scene::translation(9, 11);
    EXPECT_LE(this->update().blocks, 8u);
}

TEST_F(EditedTiles, movingBackMakesNoOutline) {
    itemOf(scene_, 200).transform = scene::translation(0.3, 0.2);
    update();
    itemOf(scene_, 200).transform = scene::identity;
    EXPECT_EQ(update().outlines, 0u);
}

TEST_F(EditedTiles, addingAndRemovingAnItemBuildsItsBlocks) {
    auto& children = scene_.root.children;
    children.insert(children.begin() + 50, scene::Node{tile(333, {0, 1, 0, 1})});
    const Update& update = this->update();
    EXPECT_EQ(update.outlines, 1u);
    EXPECT_LE(update.blocks, 4u);
    children.erase(children.begin() + 400);
    EXPECT_LE(this->update().blocks, 4u);
    EXPECT_EQ(session_.lastUpdate().outlines, 0u);
}

TEST_F(EditedTiles, swappingNeighboursMakesNoOutline) {
    std::swap(scene_.root.children[7], scene_.root.children[8]);
    const Update& update = this->update();
    EXPECT_EQ(update.outlines, 0u);
    EXPECT_LE(update.blocks, 4u);
}

TEST_F(EditedTiles, theSameSceneAgainDoesNothing) {
    const Update& update = this->update();
    EXPECT_EQ(update.outlines + update.blocks + update.paints, 0u);
}

TEST_F(EditedTiles, anotherSizeIsCompiledAnew) {
    scene_.width = columns + 1;
    EXPECT_TRUE(update().anew);
    EXPECT_EQ(session_.result().asset.width, columns + 1);
}

// ---- limits -------------------------------------------------------------------------------------

TEST(Session, doesNotKeepOutlinesForEver) {
    Scene scene = tiles();
    constexpr int corners = 5000;
    scene::Path path{scene::MoveTo{{15, 10}}};
    for (int i = 1; i < corners; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / corners;
        path.push_back(
            scene::LineTo{Point{10, 10} + (5 + 0.02 * (i % 2)) * Point{std::cos(angle), std::sin(angle)}});
    }
    itemOf(scene, 1).path = std::make_shared<scene::Path>(std::move(path));
    Session session(scene);
    int anew = 0;
    for (int i = 1; i <= 60; ++i) {
        itemOf(scene, 1).transform = scene::translation(i * 1e-2, 0);
        session.update(scene);
        anew += session.lastUpdate().anew;
    }
    EXPECT_GE(anew, 1);
    EXPECT_LE(anew, 10);
    expectFresh(session, scene);
}

/// Translucent strips that cross: each crossing is a stack of its own.
Scene strips(int count) {
    Scene scene{2.0 * count, 2.0 * count, {}};
    for (int i = 0; i < 2 * count; ++i) {
        const double at = 2 * (i % count) + 0.5, end = 2 * count;
        Item item;
        item.path = std::make_shared<scene::Path>(i < count ? scene::rectangle({at, 0}, {at + 1, end})
                                                            : scene::rectangle({0, at}, {end, at + 1}));
        item.paint = Color{float(i % 17) / 16, float(i % 29) / 28, float(i) / float(2 * count), 0.5f};
        scene.root.children.push_back({item});
    }
    return scene;
}

TEST(Session, editsMoreStacksThanTheFormatHasPaints) {
    constexpr int count = 260;
    static_assert(count * count > 65536);
    Options options;
    options.tolerance = 1.0 / 4096;
    Scene scene = strips(count);
    Session session(scene, options);
    for (const int child : {0, 300, 519}) {
        itemOf(scene, child).paint = Color{1, 0.5f, 0, 0.25f};
        session.update(scene);
        EXPECT_EQ(session.lastUpdate().blocks, 0u);
        expectFresh(session, scene, options);
    }
    itemOf(scene, 300).transform = scene::translation(0, 1.25);
    session.update(scene);
    EXPECT_FALSE(session.lastUpdate().anew);
    expectFresh(session, scene, options);
}

/// Translucent groups in each other, each with a gradient below: they cannot be folded.
Group nested(int depth) {
    Group group;
    group.opacity = 0.5f;
    group.children.push_back({tile(depth, {0, 0, 0, 1})});
    if (depth > 0)
        group.children.push_back({nested(depth - 1)});
    for (scene::Node& node : group.children)
        if (auto* item = std::get_if<Item>(&node.value)) {
            item->path = std::make_shared<scene::Path>(scene::rectangle({0, 0}, {double(columns), 9}));
            item->paint = scene::LinearGradient{{0, 0}, {columns, 0}, {{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 1}}}};
        }
    group.blend = scene::BlendMode::Multiply;
    return group;
}

TEST_F(EditedTiles, anUpdateThatThrowsLeavesTheResult) {
    const std::vector<std::uint8_t> before = asset::write(session_.result().asset);
    const Scene good = scene_;
    itemOf(scene_, 3).opacity = 2;
    EXPECT_THROW(session_.update(scene_), scene::InvalidScene);
    EXPECT_EQ(asset::write(session_.result().asset), before);
    scene_ = good;
    scene_.root.children.push_back({nested(12)});
    EXPECT_THROW(session_.update(scene_), LimitError);
    EXPECT_EQ(asset::write(session_.result().asset), before);
    scene_ = good;
    itemOf(scene_, 0).paint = Color{0, 0, 0, 1};
    update();
}

TEST(Session, compatModeIsCompiledAnew) {
    Options options;
    options.mode = asset::Mode::Compat;
    Scene scene = tiles();
    Session session(scene, options);
    itemOf(scene, 5).paint = Color{0, 0, 1, 1};
    session.update(scene);
    EXPECT_TRUE(session.lastUpdate().anew);
    EXPECT_EQ(asset::write(session.result().asset), asset::write(compile(scene, options).asset));
}

TEST(Session, refusesOptionsThatTheCompilerRefuses) {
    Options options;
    options.tolerance = 1;
    EXPECT_THROW(Session(tiles(), options), std::invalid_argument);
}

}  // namespace
}  // namespace vtm::compiler

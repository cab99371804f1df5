// What a session says has changed, as the scanner takes it: a picture that is kept up to date.

#include <algorithm>
#include <cstdlib>
#include <random>
#include <type_traits>

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
    ShownByEvaluator(const Session& session, const asset::View& view,
                     const asset::EvaluatorOptions& options = {})
        : view_(view), evaluator_(session.result().asset, options), bytes_(view) {
        evaluator_.draw(view_, bytes_.target());
    }

    /// Returns how many pixels were drawn.
    std::size_t update(const Session& session) {
        evaluator_.update(session.result().asset, session.difference());
        return drawChanges(evaluator_, session, view_, bytes_);
    }
    void redraw() { evaluator_.draw(view_, bytes_.target()); }

    void expectFresh(const Session& session) const {
        Bytes fresh(view_), whole(view_);
        asset::Evaluator(session.result().asset).draw(view_, fresh.target());
        evaluator_.draw(view_, whole.target());
        EXPECT_LE(largestDifference(whole, fresh), 1);
        expectFresh(fresh);
    }
    /// `asset`: of a new compilation.
    void expectFresh(const asset::Asset& asset) const {
        Bytes fresh(view_);
        asset::Evaluator(asset).draw(view_, fresh.target());
        expectFresh(fresh);
    }

private:
    void expectFresh(const Bytes& fresh) const {
        // Of three blurs after each other, each within 1/255, what is drawn may end elsewhere.
        EXPECT_LE(largestDifference(bytes_, fresh), 2);
    }

    asset::View view_;
    asset::Evaluator evaluator_;
    Bytes bytes_;
};

/// The same with what filters made before, of which nothing is made anew but for boxes.
class ShownByKeptResults : public ShownByEvaluator {
public:
    ShownByKeptResults(const Session& session, const asset::View& view)
        : ShownByEvaluator(session, view, {.keepsFilterResults = true}) {}

    /// Parts that were edited once are edited by squares: now and then results of such are kept.
    std::size_t update(const Session& session) {
        const std::size_t pixels = ShownByEvaluator::update(session);
        if (++updates_ % 4 == 0)
            redraw();
        return pixels;
    }
    void expectFresh(const Session&) const {}

private:
    int updates_ = 0;
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
        if constexpr (std::is_base_of_v<ShownByEvaluator, Kept>) {
            const asset::Asset fresh = compile(editor.scene()).asset;
            for (const ShownByEvaluator* shown : {&upright, &turned, &small})
                shown->expectFresh(fresh);
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
TEST_P(ShownFilters, AreDrawnWhereTheyAreFromWhatIsKept) {
    expectShown<ShownByKeptResults>({GetParam(), 30, test::RandomEditor::Filters::Some});
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

// ---- pictures with filters, as people draw them --------------------------------------------------

std::shared_ptr<const scene::Filter> filterOf(scene::FilterOperation operation) {
    const scene::Point min(-20), max(84);
    return std::make_shared<scene::Filter>(
        scene::Filter{scene::identity, min, max, {{std::move(operation), {{}}, min, max, false}}});
}
std::shared_ptr<const scene::Filter> shadow() {
    return filterOf(scene::DropShadowFilter{0.5f, 0.7f, 0.8f, 0.8f, {0, 0, 0, 0.6f}});
}
std::shared_ptr<const scene::Filter> blur(float deviation) {
    return filterOf(scene::GaussianBlurFilter{deviation, deviation});
}

class Drawings {
public:
    explicit Drawings(unsigned seed) : random_(seed) {}

    scene::Scene cards() {
        scene::Scene scene = ground();
        for (int i = 0; i < 16; ++i) {
            const scene::Point at(3 + 15 * (i % 4), 3 + 15 * (i / 4));
            scene::Group card = items(4, at + 1.0, at + 10.0);
            card.children.insert(card.children.begin(), {item(at, at + 12.0, 1)});
            card.filter = shadow();
            scene.root.children.push_back({std::move(card)});
            scene.root.children.push_back({items(2, at, at + 14.0)});
        }
        return scene;
    }
    scene::Scene blurredGround() {
        scene::Scene scene = ground();
        scene::Group blurred = items(40, scene::Point(0), scene::Point(60));
        blurred.filter = blur(2.5f);
        scene.root.children.push_back({std::move(blurred)});
        scene.root.children.push_back({items(30, scene::Point(0), scene::Point(60))});
        return scene;
    }
    scene::Scene nested() {
        scene::Scene scene = ground();
        for (int i = 0; i < 3; ++i) {
            const scene::Point at(4 + 16 * i, 20);
            scene::Group inner = items(6, at, at + 14.0), outer = items(6, at, at + 20.0);
            inner.filter = shadow();
            outer.children.insert(outer.children.begin() + 3, {std::move(inner)});
            outer.filter = i == 1 ? blur(0.7f) : shadow();
            scene.root.children.push_back({std::move(outer)});
        }
        return scene;
    }
    scene::Scene masksAndClips() {
        scene::Scene scene = ground();
        for (int i = 0; i < 4; ++i) {
            const scene::Point at(2 + 14 * i, 6 + 10 * i);
            scene::Group filtered = items(8, at, at + 16.0), outer;
            filtered.filter = blur(0.6f);
            filtered.opacity = 0.8f;
            outer.children.push_back({std::move(filtered)});
            if (i % 2 == 0)
                outer.clip = clip(at + 2.0, at + 13.0);
            else
                outer.mask = mask(at, i == 3);
            outer.blend = i == 1 ? scene::BlendMode::Multiply : scene::BlendMode::Normal;
            scene.root.children.push_back({std::move(outer)});
            scene.root.children.push_back({items(2, at, at + 18.0)});
        }
        return scene;
    }

    /// Moves or recolours an item that is drawn; items in masks stay.
    void edit(scene::Scene& scene) {
        std::vector<scene::Item*> all;
        collect(scene.root, all);
        scene::Item& item = *all[random_() % all.size()];
        if (random_() % 4 == 0)
            item.paint = color(1);
        else
            item.transform =
                scene::compose(scene::translation(uniform(-3, 3), uniform(-3, 3)), item.transform);
    }

private:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    scene::Color color(float alpha) {
        return {float(uniform(0, 1)), float(uniform(0, 1)), float(uniform(0, 1)), alpha};
    }
    scene::Item item(scene::Point min, scene::Point max, float alpha) {
        scene::Item item;
        item.path =
            std::make_shared<scene::Path>(scene::Path{scene::MoveTo{min}, scene::QuadTo{{max.x, min.y}, max},
                                                      scene::LineTo{{min.x, max.y}}, scene::Close{}});
        item.paint = color(alpha);
        return item;
    }
    scene::Group items(int count, scene::Point min, scene::Point max) {
        scene::Group group;
        for (int i = 0; i < count; ++i) {
            const scene::Point at(uniform(min.x, max.x), uniform(min.y, max.y));
            group.children.push_back({item(at, at + uniform(1, 6), i % 3 == 0 ? 0.5f : 1)});
        }
        return group;
    }
    scene::Scene ground() {
        scene::Scene scene{64, 64, {}};
        scene.root.children.push_back({item({-10, -10}, {80, 80}, 1)});
        scene.root.children.push_back({items(20, scene::Point(0), scene::Point(60))});
        return scene;
    }
    static std::shared_ptr<const scene::Clip> clip(scene::Point min, scene::Point max) {
        auto clip = std::make_shared<scene::Clip>();
        clip->shapes.push_back({std::make_shared<scene::Path>(scene::rectangle(min, max)), scene::identity,
                                scene::FillRule::NonZero, nullptr});
        return clip;
    }
    std::shared_ptr<const scene::Mask> mask(scene::Point at, bool isFiltered) {
        auto content = std::make_shared<scene::Group>(items(5, at, at + 12.0));
        if (isFiltered)
            content->filter = blur(0.5f);
        auto mask = std::make_shared<scene::Mask>();
        mask->content = std::move(content);
        mask->kind = scene::MaskKind::Alpha;
        return mask;
    }
    static void collect(scene::Group& group, std::vector<scene::Item*>& into) {
        for (scene::Node& node : group.children)
            if (auto* inner = std::get_if<scene::Group>(&node.value))
                collect(*inner, into);
            else if (auto* item = std::get_if<scene::Item>(&node.value))
                into.push_back(item);
    }

    std::mt19937 random_;
};

struct Drawing {
    const char* name;
    scene::Scene (Drawings::*make)();
};
void PrintTo(const Drawing& drawing, std::ostream* out) { *out << drawing.name; }

class ShownDrawings : public testing::TestWithParam<Drawing> {};
INSTANTIATE_TEST_SUITE_P(Drawing, ShownDrawings,
                         testing::Values(Drawing{"cards", &Drawings::cards},
                                         Drawing{"blurred ground", &Drawings::blurredGround},
                                         Drawing{"nested", &Drawings::nested},
                                         Drawing{"masks and clips", &Drawings::masksAndClips}));

/// Boxes, from evaluators with and without what filters made, beside a new compilation; of one picture of
/// those between filters at a time, and of less than the whole.
TEST_P(ShownDrawings, AreDrawnWhereTheyAre) {
    Drawings drawings(7);
    scene::Scene scene = (drawings.*GetParam().make)();
    Session session(scene);
    const asset::View upright = view(200, 3, 0), turned = view(120, 1.5, 0.3);
    std::vector<ShownByEvaluator> all;
    for (const asset::View& of : {upright, turned})
        for (const bool keeps : {false, true})
            all.emplace_back(session, of, asset::EvaluatorOptions{keeps});
    std::size_t pixels = 0, edited = 0;
    constexpr int edits = 30;
    for (int i = 0; i < edits && !HasFailure(); ++i) {
        drawings.edit(scene);
        session.update(scene);
        EXPECT_LE(session.lastUpdate().blocks, 1u);  // none if it is beside all that is seen
        for (const asset::MapChange& map : session.difference().maps)
            edited += map.before != asset::MapChange::isNew && (!map.squares.empty() || map.paints);
        const asset::Asset fresh = compile(scene).asset;
        for (ShownByEvaluator& shown : all) {
            pixels += shown.update(session);
            shown.expectFresh(fresh);
            if (i % 8 == 7)
                shown.redraw();
        }
    }
    EXPECT_GT(edited, std::size_t(edits) / 4);  // others were edited for the first time, or have one item
    EXPECT_LT(pixels, edits * 2 * (200 * 200 + 120 * 120) / 3);
}

/// Every update compiles all of it, and says nothing of maps.
TEST(ShownSession, FiltersInCompatMode) {
    Drawings drawings(3);
    scene::Scene scene = drawings.cards();
    const Options compat{.mode = asset::Mode::Compat};
    Session session(scene, compat);
    ShownByEvaluator shown(session, view(200, 3, 0), {.keepsFilterResults = true});
    for (int i = 0; i < 8; ++i) {
        drawings.edit(scene);
        session.update(scene);
        shown.update(session);
        shown.expectFresh(compile(scene, compat).asset);
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

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "scene/tests/scenes.hpp"

namespace vtm::scene {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr float nanf = std::numeric_limits<float>::quiet_NaN();

std::string complaint(const Scene& scene) {
    try {
        validate(scene);
    } catch (const InvalidScene& e) {
        return e.what();
    }
    return "";
}

std::string complaint(Item item) { return complaint(sceneOf(std::move(item))); }

Item painted(Paint paint) {
    Item item = redSquare();
    item.paint = std::move(paint);
    return item;
}

Item stroked(const std::function<void(StrokeStyle&)>& change) {
    Item item = redSquare();
    StrokeStyle style;
    change(style);
    item.geometry = style;
    return item;
}

Item drawn(Path path) {
    Item item = redSquare();
    item.path = std::make_shared<const Path>(std::move(path));
    return item;
}

TEST(Validate, AcceptsWhatIsInOrder) {
    EXPECT_EQ(complaint(redSquare()), "");
    EXPECT_EQ(complaint(painted(ramp())), "");
    EXPECT_EQ(complaint(painted(rings())), "");
    EXPECT_EQ(complaint(stroked([](StrokeStyle& s) { s.dashes = {0, 2}; })), "");
    EXPECT_EQ(complaint(drawn({})), "");
    EXPECT_EQ(
        complaint(drawn({MoveTo{{0, 0}}, ArcTo{{-1, 0}, 9, true, false, {0, 0}}, Close{}, LineTo{{1, 1}}})),
        "");
    Scene empty;
    empty.width = empty.height = 1;
    EXPECT_EQ(complaint(empty), "");
}

TEST(Validate, Size) {
    Scene s = sceneOf(redSquare());
    for (const double side : {minSide, maxSide}) {
        s.width = s.height = side;
        EXPECT_EQ(complaint(s), "") << side;
    }
    for (const double bad : {0.0, -1.0, nan, infinity, 1e-38, 0.999 * minSide, 1.001 * maxSide}) {
        s.width = bad;
        EXPECT_NE(complaint(s), "") << bad;
    }
    s.width = 1;
    s.height = -2;
    EXPECT_EQ(complaint(s), "scene: height is -2, not in [2^-40, 2^40]");
}

TEST(Validate, NamesTheNode) {
    Scene s = sceneOf(redSquare());
    Group inner;
    inner.children.push_back({stroked([](StrokeStyle& style) { style.width = -1; })});
    s.root.children.push_back({redSquare()});
    s.root.children.push_back({inner});
    EXPECT_EQ(complaint(s), "root/2/0: stroke width is -1, not > 0");
}

TEST(Validate, Paths) {
    EXPECT_EQ(complaint(drawn({LineTo{{0, 0}}})), "root/0/path: does not begin with MoveTo");
    EXPECT_EQ(complaint(drawn({MoveTo{{0, 0}}, LineTo{{nan, 0}}})), "root/0/path: command 1 is not finite");
    for (const Command& c :
         {Command{MoveTo{{infinity, 0}}}, Command{QuadTo{{nan, 0}, {0, 0}}},
          Command{CubicTo{{0, 0}, {0, nan}, {0, 0}}}, Command{ArcTo{{1, nan}, 0, true, true, {0, 0}}},
          Command{ArcTo{{1, 1}, nan, true, true, {0, 0}}}})
        EXPECT_NE(complaint(drawn({MoveTo{{0, 0}}, c})), "");
    Item none = redSquare();
    none.path = nullptr;
    EXPECT_EQ(complaint(none), "root/0/path: is missing");
}

TEST(Validate, Items) {
    Item item = redSquare();
    item.opacity = 1.5f;
    EXPECT_EQ(complaint(item), "root/0: opacity is 1.5, not in [0, 1]");
    item = redSquare();
    item.transform[2].x = nan;
    EXPECT_EQ(complaint(item), "root/0: transform is not finite");
    item = redSquare();
    item.geometry = FillRule(7);
    EXPECT_EQ(complaint(item), "root/0: fill rule 7 is unknown");
}

TEST(Validate, Strokes) {
    const std::vector<std::function<void(StrokeStyle&)>> faults{[](StrokeStyle& s) { s.width = 0; },
                                                                [](StrokeStyle& s) { s.width = infinity; },
                                                                [](StrokeStyle& s) { s.miterLimit = 0.5; },
                                                                [](StrokeStyle& s) { s.miterLimit = nan; },
                                                                [](StrokeStyle& s) { s.dashes = {1}; },
                                                                [](StrokeStyle& s) {
                                                                    s.dashes = {0, 0};
                                                                },
                                                                [](StrokeStyle& s) {
                                                                    s.dashes = {-1, 2};
                                                                },
                                                                [](StrokeStyle& s) {
                                                                    s.dashes = {nan, 1};
                                                                },
                                                                [](StrokeStyle& s) {
                                                                    s.dashes = {infinity, 1};
                                                                },
                                                                [](StrokeStyle& s) { s.dashPhase = nan; },
                                                                [](StrokeStyle& s) { s.cap = Cap(3); },
                                                                [](StrokeStyle& s) { s.join = Join(-1); }};
    for (std::size_t i = 0; i < faults.size(); ++i)
        EXPECT_EQ(complaint(stroked(faults[i])).rfind("root/0: ", 0), 0u) << i;
}

template <class Gradient>
void expectBad(Gradient gradient, const std::function<void(Gradient&)>& change) {
    change(gradient);
    EXPECT_EQ(complaint(painted(gradient)).rfind("root/0: ", 0), 0u) << complaint(painted(gradient));
}

TEST(Validate, LinearGradients) {
    using G = LinearGradient;
    expectBad<G>(ramp(), [](G& g) { g.end = g.start; });
    expectBad<G>(ramp(), [](G& g) { g.end.x = nan; });
    expectBad<G>(ramp(), [](G& g) { g.stops.pop_back(); });
    expectBad<G>(ramp(), [](G& g) { g.stops[0].offset = -0.1f; });
    expectBad<G>(ramp(), [](G& g) { g.stops[1].offset = nanf; });
    expectBad<G>(ramp(), [](G& g) { g.stops.push_back({0.5f, {}}); });
    expectBad<G>(ramp(), [](G& g) { g.stops[1].color.a = 2; });
    expectBad<G>(ramp(), [](G& g) { g.spread = Spread(3); });
    expectBad<G>(ramp(), [](G& g) { g.transform[0].x = infinity; });
}

TEST(Validate, RadialGradients) {
    using G = RadialGradient;
    expectBad<G>(rings(), [](G& g) { g.radius = 0; });
    expectBad<G>(rings(), [](G& g) { g.radius = infinity; });
    expectBad<G>(rings(), [](G& g) { g.focalRadius = infinity; });
    expectBad<G>(rings(), [](G& g) { g.focalRadius = -1; });
    expectBad<G>(rings(), [](G& g) {
        g.focus = g.center;
        g.focalRadius = g.radius;
    });
    expectBad<G>(rings(), [](G& g) { g.focus.y = nan; });
}

TEST(Validate, Colours) {
    expectBad<Color>({}, [](Color& c) { c.r = -0.5f; });
    expectBad<Color>({}, [](Color& c) { c.a = nanf; });
}

TEST(Validate, Patterns) {
    auto content = std::make_shared<Group>();
    content->children.push_back({redSquare()});
    EXPECT_EQ(complaint(painted(Pattern{{0, 0}, {1, 1}, content, identity})), "");
    expectBad<Pattern>({{0, 0}, {1, 1}, content, identity}, [](Pattern& p) { p.max.x = 0; });
    expectBad<Pattern>({{0, 0}, {1, 1}, content, identity}, [](Pattern& p) { p.transform[1].y = nan; });
    EXPECT_EQ(complaint(painted(Pattern{{0, 0}, {1, 1}, nullptr, identity})), "root/0/pattern: is missing");
    std::get<Item>(content->children[0].value).opacity = -1;
    EXPECT_EQ(complaint(painted(Pattern{{0, 0}, {1, 1}, content, identity})),
              "root/0/pattern/0: opacity is -1, not in [0, 1]");
}

TEST(Validate, Images) {
    auto bitmap = std::make_shared<image::Bitmap>();
    bitmap->width = 2;
    bitmap->height = 3;
    bitmap->rgba.resize(24);
    EXPECT_EQ(complaint(painted(ImagePaint{bitmap})), "");
    bitmap->rgba.pop_back();
    EXPECT_EQ(complaint(painted(ImagePaint{bitmap})), "root/0: image of 2 x 3 pixels has 23 bytes");
    bitmap->width = 0;
    EXPECT_NE(complaint(painted(ImagePaint{bitmap})), "");
    EXPECT_NE(complaint(painted(ImagePaint{nullptr})), "");
}

TEST(Validate, ClipsAndMasks) {
    Scene s = sceneOf(redSquare());
    auto deeper = std::make_shared<Clip>();
    deeper->shapes.push_back({unitSquare(), identity, FillRule::EvenOdd, nullptr});
    auto clip = std::make_shared<Clip>();
    clip->shapes.push_back({unitSquare(), identity, FillRule::NonZero, deeper});
    clip->clip = deeper;
    s.root.clip = clip;
    auto content = std::make_shared<Group>();
    s.root.mask = std::make_shared<const Mask>(Mask{content});
    EXPECT_EQ(complaint(s), "");
    content->blend = BlendMode(17);
    EXPECT_EQ(complaint(s), "root/mask: blend mode 17 is unknown");
    deeper->shapes[0].path = nullptr;
    EXPECT_EQ(complaint(s), "root/clip/clip/0/path: is missing");
    s.root.clip = nullptr;
    s.root.mask = std::make_shared<const Mask>(Mask{nullptr});
    EXPECT_EQ(complaint(s), "root/mask: is missing");
    s.root.mask = std::make_shared<const Mask>(Mask{std::make_shared<Group>(), MaskKind(2)});
    EXPECT_EQ(complaint(s), "root/mask: mask kind 2 is unknown");
}

/// `levels` groups, each but the last with one child.
Group nested(int levels) {
    Group g;
    for (int i = 1; i < levels; ++i) {
        Group outer;
        outer.children.push_back({std::move(g)});
        g = std::move(outer);
    }
    return g;
}

TEST(Validate, NestingIsLimited) {
    Scene s;
    s.width = s.height = 1;
    s.root = nested(maxNesting);
    EXPECT_EQ(complaint(s), "");
    s.root = nested(maxNesting + 1);
    EXPECT_NE(complaint(s).find("nested more than 1024 levels"), std::string::npos);
    EXPECT_LT(complaint(s).size(), 200u);
    EXPECT_FALSE(dump(s).empty());
}

TEST(Validate, NestedPatternsAreLimited) {
    auto content = std::make_shared<const Group>();
    for (int i = 0; i < 4 * maxNesting; ++i) {
        Group outer;
        outer.children.push_back({painted(Pattern{{0, 0}, {1, 1}, content, identity})});
        content = std::make_shared<const Group>(std::move(outer));
    }
    const Scene s = sceneOf(painted(Pattern{{0, 0}, {1, 1}, content, identity}));
    EXPECT_NE(complaint(s).find("nested more than 1024 levels"), std::string::npos);
    EXPECT_FALSE(dump(s).empty());
}

TEST(Validate, SharedPartsCountOnEveryWayToThem) {
    // Seen first near the root, where all is well, then again at the bottom of a deep chain.
    const auto content = std::make_shared<const Group>(nested(600));
    const Item user = painted(Pattern{{0, 0}, {1, 1}, content, identity});
    Scene s = sceneOf(user);
    EXPECT_EQ(complaint(s), "");
    Group bottom;
    bottom.children.push_back({user});
    for (int i = 0; i < 600; ++i) {
        Group outer;
        outer.children.push_back({std::move(bottom)});
        bottom = std::move(outer);
    }
    s.root.children.push_back({std::move(bottom)});
    EXPECT_NE(complaint(s).find("nested more than 1024 levels"), std::string::npos);
}

TEST(Validate, Materials) {
    const Material plain{"plain_1", "vec4 plain_1(vec2 p) { return vec4(0.0); }", {}, identity};
    const auto changed = [&](const std::function<void(Material&)>& change) {
        Material material = plain;
        change(material);
        return complaint(painted(material));
    };
    EXPECT_EQ(complaint(painted(plain)), "");
    for (const std::string name : {"", "1a", "_a", "a b", "a__b", "gl_a", "ä"})
        EXPECT_EQ(changed([&](Material& m) { m.name = name; }),
                  "root/0: material name '" + name + "' is not a plain identifier");
    EXPECT_NE(changed([](Material& m) { m.name.assign(maxMaterialName + 1, 'a'); }), "");
    EXPECT_NE(changed([](Material& m) { m.glsl.assign(maxMaterialText + 1, ' '); }), "");
    EXPECT_NE(changed([](Material& m) { m.glsl += '\0'; }), "");
    EXPECT_NE(changed([](Material& m) { m.fallback.r = 2; }), "");
    EXPECT_NE(changed([](Material& m) { m.transform[0].x = nan; }), "");
}

TEST(Validate, AMaterialHasOneText) {
    Scene s = sceneOf(painted(Material{"a", "one", {}, identity}));
    s.root.children.push_back({painted(Material{"a", "one", {1, 0, 0, 1}, scaling(2, 2)})});
    EXPECT_EQ(complaint(s), "");
    s.root.children.push_back({painted(Material{"a", "two", {}, identity})});
    EXPECT_EQ(complaint(s), "root/2: material 'a' has another text than before");
}

TEST(Validate, SelectionsCountAsALevelOnBothSides) {
    Select select{{unitSquare(), identity, FillRule::NonZero}, nullptr, nullptr};
    Scene s = sceneOf(redSquare());
    s.root.children.push_back({select});
    EXPECT_EQ(complaint(s), "");
    for (auto* side : {&select.inside, &select.outside}) {
        *side = std::make_shared<const Group>(nested(maxNesting - 2));
        s.root.children.back() = {select};
        EXPECT_EQ(complaint(s), "");
        *side = std::make_shared<const Group>(nested(maxNesting - 1));
        s.root.children.back() = {select};
        EXPECT_NE(complaint(s).find("nested more than 1024 levels"), std::string::npos);
        *side = nullptr;
    }
}

TEST(Validate, SelectionsNameWhereTheyAreWrong) {
    Select select{{unitSquare(), scaling(nan, 1), FillRule::NonZero}, nullptr, nullptr};
    Scene s = sceneOf(redSquare());
    s.root.children.push_back({select});
    EXPECT_EQ(complaint(s), "root/1: transform is not finite");
    select.mask.transform = identity;
    Group side;
    side.opacity = 2;
    select.outside = std::make_shared<const Group>(side);
    s.root.children.back() = {select};
    EXPECT_EQ(complaint(s), "root/1/outside: opacity is 2, not in [0, 1]");
    select.mask.path = nullptr;
    s.root.children.back() = {select};
    EXPECT_EQ(complaint(s), "root/1/path: is missing");
}

TEST(Validate, KnownPathsAreNotLookedAtAllElseIs) {
    Item item = redSquare();
    const auto broken = std::make_shared<const Path>(Path{LineTo{{1, 1}}});
    item.path = broken;
    const auto isKnown = [&](const Path& path) { return &path == broken.get(); };
    EXPECT_NO_THROW(validate(sceneOf(item), isKnown));
    EXPECT_THROW(validate(sceneOf(item)), InvalidScene);
    item.opacity = 2;
    EXPECT_THROW(validate(sceneOf(item), isKnown), InvalidScene);
    item = redSquare();
    item.path = std::make_shared<const Path>(*broken);
    EXPECT_THROW(validate(sceneOf(item), isKnown), InvalidScene);
}

TEST(Validate, SharingTakesNoExponentialTime) {
    auto content = std::make_shared<const Group>();
    for (int i = 0; i < 200; ++i) {
        Group outer;
        for (int k = 0; k < 2; ++k)
            outer.children.push_back({painted(Pattern{{0, 0}, {1, 1}, content, identity})});
        content = std::make_shared<const Group>(std::move(outer));
    }
    const Scene s = sceneOf(painted(Pattern{{0, 0}, {1, 1}, content, identity}));
    EXPECT_EQ(complaint(s), "");
    EXPECT_LT(dump(s).size(), 1u << 20);
}

}  // namespace
}  // namespace vtm::scene

// Paper mode, compilation: a test a row of the paper's table (docs/paper.md).

#include "paper/compile.hpp"
#include "paper/evaluate.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace vtm::paper {
namespace {

using scene::FillRule;
using scene::Path;
using scene::Point;

/// User units of every picture here.
constexpr double side = 100;

Path disc(Point centre, double radius) {
    const Point left{centre.x - radius, centre.y}, right{centre.x + radius, centre.y};
    return {scene::MoveTo{left}, scene::ArcTo{{radius, radius}, 0, false, true, right},
            scene::ArcTo{{radius, radius}, 0, false, true, left}, scene::Close{}};
}

Path joined(Path a, const Path& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

scene::Item filled(const Path& path, const scene::Paint& paint = scene::Color{1, 0, 0, 1},
                   FillRule rule = FillRule::NonZero) {
    scene::Item item;
    item.path = std::make_shared<Path>(path);
    item.geometry = rule;
    item.paint = paint;
    return item;
}

scene::Item stroked(const Path& path, double width) {
    scene::Item item = filled(path);
    scene::StrokeStyle style;
    style.width = width;
    item.geometry = style;
    return item;
}

scene::Scene sceneOf(std::vector<scene::Node> nodes) {
    scene::Scene scene;
    scene.width = scene.height = side;
    scene.root.children = std::move(nodes);
    return scene;
}

CompileResult compiled(const scene::Item& item, const CompileOptions& options = {}) {
    return compile(sceneOf({{item}}), options);
}

const Mask& maskOf(const CompileResult& result, std::size_t item = 0) {
    return result.asset.masks[result.maskOfItem[item]];
}

/// Signed distance to the truth, above zero inside; points nearer than `skip` are not asked about.
void expectClassified(const CompileResult& result, const std::function<double(Point)>& distance,
                      double skip = 0.01) {
    std::mt19937 random(16);
    std::uniform_real_distribution<double> place(0, side);
    int wrong = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Point p(place(random), place(random));
        const double d = distance(p);
        if (std::abs(d) > skip && classify(maskOf(result), p) != (d > 0))
            ++wrong;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(result.approximatedCells(), 0u);
}

// ---- Rows 1, 2, 3 -------------------------------------------------------------------------------

TEST(PaperRow1, CurvesBecomeHermitePieces) {
    const CompileResult result = compiled(filled(disc({50, 50}, 30)));
    expectClassified(result, [](Point p) { return 30 - glm::distance(p, {50, 50}); });
    int curved = 0;
    for (const Cell& cell : maskOf(result).cells)
        curved += cell.pieces[0].slopeA != 0 ? 1 : 0;
    EXPECT_GT(curved, 0);
}

TEST(PaperRow1, PiecesAreWithinTheTolerance) {
    CompileOptions options;
    options.tolerance = 1.0 / 4096;
    // Cells may add three steps of their coordinates: 0.003 on the whole mask.
    expectClassified(
        compiled(filled(disc({50, 50}, 45)), options),
        [](Point p) {
            return 45 - glm::distance(p, {50, 50});
        },
        side / 4096 + 0.006);
}

/// Cells of two pieces with the operator.
int pairs(const Mask& mask, Operator combine) {
    int count = 0;
    for (const Cell& cell : mask.cells)
        count += cell.count == 2 && cell.combine == combine ? 1 : 0;
    return count;
}

TEST(PaperRow2, ConvexCornersIntersectAndReflexOnesUnite) {
    const CompileResult square = compiled(filled(scene::polygon({{21, 23}, {79, 25}, {77, 81}, {19, 76}})));
    EXPECT_EQ(square.approximatedCells(), 0u);
    EXPECT_GE(pairs(maskOf(square), Operator::Intersection), 4);
    EXPECT_EQ(pairs(maskOf(square), Operator::Union), 0);
    const CompileResult hole =
        compiled(filled(joined(scene::rectangle({-9, -9}, {109, 109}),
                               scene::polygon({{21, 23}, {79, 25}, {77, 81}, {19, 76}})),
                        scene::Color{}, FillRule::EvenOdd));
    EXPECT_EQ(hole.approximatedCells(), 0u);
    EXPECT_GE(pairs(maskOf(hole), Operator::Union), 4);
}

TEST(PaperRow2, ThinFeaturesAreTwoPieces) {
    const auto band = [](Point p) { return 0.25 - std::abs(p.y - 50.1); };
    const CompileResult result =
        compiled(filled(scene::polygon({{-50, 49.85}, {150, 49.85}, {150, 50.35}, {-50, 50.35}})));
    expectClassified(result, band);
    EXPECT_GT(pairs(maskOf(result), Operator::Intersection), 0);
}

TEST(PaperRow3, HolesAndSeveralComponents) {
    const Path path = joined(joined(disc({30, 50}, 20), disc({30, 50}, 10)), disc({75, 50}, 12));
    const CompileResult result = compiled(filled(path, scene::Color{}, FillRule::EvenOdd));
    expectClassified(result, [](Point p) {
        const double r = glm::distance(p, {30, 50});
        return std::max(std::min(20 - r, r - 10), 12 - glm::distance(p, {75, 50}));
    });
}

TEST(PaperRow3, TheFillRuleDecidesWhatIsInside) {
    const Path twice = joined(disc({50, 50}, 30), disc({50, 50}, 15));
    expectClassified(compiled(filled(twice)), [](Point p) { return 30 - glm::distance(p, {50, 50}); });
}

TEST(PaperRow3, OverlapsWithinAnItemLeaveNoBoundary) {
    const Path overlap = joined(disc({40, 50}, 25), disc({60, 50}, 25));
    expectClassified(compiled(filled(overlap)), [](Point p) {
        return std::max(25 - glm::distance(p, {40, 50}), 25 - glm::distance(p, {60, 50}));
    });
    // The stroke's outline turns back on itself at the join and crosses itself in the middle.
    const Path bow{scene::MoveTo{{20, 20}}, scene::LineTo{{80, 80}}, scene::LineTo{{80, 20}},
                   scene::LineTo{{20, 80}}};
    const auto segment = [](Point p, Point a, Point b) {
        const double s = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        return glm::distance(p, a + s * (b - a));
    };
    scene::Item bowTie = stroked(bow, 8);
    std::get<scene::StrokeStyle>(bowTie.geometry).cap = scene::Cap::Round;
    std::get<scene::StrokeStyle>(bowTie.geometry).join = scene::Join::Round;
    expectClassified(compiled(bowTie), [&](Point p) {
        return 4 - std::min({segment(p, {20, 20}, {80, 80}), segment(p, {80, 80}, {80, 20}),
                             segment(p, {80, 20}, {20, 80})});
    });
}

TEST(PaperRow2, WhatAStrictCellCannotSayIsCounted) {
    // Even-odd, two crossing bars: at the crossings of edges inside is where exactly one side is.
    const Path bars = joined(scene::polygon({{10, 40}, {90, 45}, {90, 60}, {10, 55}}),
                             scene::polygon({{40, 10}, {60, 12}, {55, 90}, {43, 88}}));
    const CompileResult result = compiled(filled(bars, scene::Color{}, FillRule::EvenOdd));
    EXPECT_GE(result.approximatedCells(), 4u);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].find("cells would need more"), std::string::npos);
    EXPECT_EQ(compiled(filled(bars)).approximatedCells(), 0u) << "a union is what a strict cell can say";
}

// ---- Row 5 --------------------------------------------------------------------------------------

const Footprint sharp(glm::dmat2(16));

glm::vec4 colorAt(const CompileResult& result, Point p) { return sample(result.asset, p, sharp).color; }

void expectColor(const CompileResult& result, Point p, glm::vec4 color) {
    const glm::vec4 found = colorAt(result, p);
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(found[c], color[c], 1e-5) << "channel " << c << " at " << p.x << ", " << p.y;
}

TEST(PaperRow5, PaintersOrderFoldsIntoNodes) {
    scene::Item pale = filled(disc({60, 50}, 25), scene::Color{0, 0, 1, 0.5f});
    const CompileResult result = compile(sceneOf({{filled(disc({40, 50}, 25))}, {pale}}));
    EXPECT_EQ(result.asset.nodes.size(), 2u);
    expectColor(result, {20, 50}, {1, 0, 0, 1});
    expectColor(result, {50, 50}, {0.5, 0, 0.5, 1});
    expectColor(result, {80, 50}, {0, 0, 0.5, 0.5});
    expectColor(result, {5, 5}, {0, 0, 0, 0});
}

TEST(PaperRow5, ClipsAndTheOpacityOfGroupsAreNodesToo) {
    auto clip = std::make_shared<scene::Clip>();
    clip->shapes.push_back(
        {std::make_shared<Path>(disc({30, 50}, 15)), scene::identity, FillRule::NonZero, nullptr});
    clip->shapes.push_back(
        {std::make_shared<Path>(disc({70, 50}, 15)), scene::identity, FillRule::NonZero, nullptr});
    scene::Group group;
    group.opacity = 0.5f;
    group.clip = clip;
    group.children = {{filled(scene::rectangle({0, 0}, {60, 100}))},
                      {filled(scene::rectangle({40, 0}, {100, 100}), scene::Color{0, 1, 0, 1})}};
    const CompileResult result =
        compile(sceneOf({{filled(scene::rectangle({0, 0}, {100, 100}), scene::Color{0, 0, 1, 1})}, {group}}));
    EXPECT_TRUE(result.warnings.empty());
    expectColor(result, {30, 50}, {0.5, 0, 0.5, 1});
    expectColor(result, {70, 50}, {0, 0.5, 0.5, 1});
    expectColor(result, {50, 50}, {0, 0, 1, 1});
}

/// Discs all over the picture, some of them in groups with opacity or a clip.
scene::Scene manyDiscs(unsigned seed, std::size_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<scene::Node> nodes;
    const auto one = [&] {
        const auto channel = [&] { return float(unit(random)); };
        return filled(
            disc({-10 + 120 * unit(random), -10 + 120 * unit(random)}, 1 + 8 * unit(random) * unit(random)),
            scene::Color{channel(), channel(), channel(), unit(random) < 0.5 ? 1.0f : channel()});
    };
    while (nodes.size() < count) {
        if (unit(random) > 0.2) {
            nodes.push_back({one()});
            continue;
        }
        scene::Group group;
        for (int i = 0; i < 9; ++i)
            group.children.push_back({one()});
        if (unit(random) < 0.5)
            group.opacity = 0.5f;
        nodes.push_back({group});
    }
    return sceneOf(std::move(nodes));
}

TEST(PaperRow5, BalancedTreesDrawWhatSequencesDo) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const scene::Scene scene = manyDiscs(seed, 10 + 60 * seed);
        const CompileResult tree = compile(scene), sequence = compile(scene, {.balanced = false});
        EXPECT_FALSE(tree.bounded.empty());
        EXPECT_TRUE(sequence.bounded.empty());
        for (const double zoom : {0.07, 0.6, 3.0}) {
            const asset::View view{60, 60, {zoom, 0.2 * zoom, -0.2 * zoom, zoom, 3.3, -2.1}};
            Cost few, many;
            EXPECT_EQ(evaluate(tree.asset, view, &few).rgba, evaluate(sequence.asset, view, &many).rgba)
                << seed;
            EXPECT_LE(few.nodes, many.nodes * 3 / 2) << seed;
        }
    }
}

TEST(PaperRow5, BalancedTreesStepOverWhatLiesElsewhere) {
    std::vector<scene::Node> nodes;
    for (int i = 0; i < 256; ++i)  // row by row, as drawings are made part by part
        nodes.push_back({filled(disc({3 + 6.0 * (i % 16), 3 + 6.0 * (i / 16)}, 2.5))});
    const scene::Scene scene = sceneOf(nodes);
    const asset::View view{100, 100, {1, 0, 0, 1, 0, 0}};
    Cost few, many;
    evaluate(compile(scene).asset, view, &few);
    evaluate(compile(scene, {.balanced = false}).asset, view, &many);
    EXPECT_LT(few.nodes * 8, many.nodes);
}

TEST(PaperRow5, SelectionsAreTheModelItself) {
    scene::Group inside, outside;
    inside.children = {{filled(scene::rectangle({0, 0}, {100, 50}))}};
    outside.children = {{filled(scene::rectangle({0, 0}, {100, 100}), scene::Color{0, 1, 0, 0.5f})}};
    scene::Select choice;
    choice.mask.path = std::make_shared<Path>(disc({50, 50}, 20));
    choice.mask.geometry = FillRule::NonZero;
    choice.inside = std::make_shared<scene::Group>(inside);
    choice.outside = std::make_shared<scene::Group>(outside);
    const CompileResult result = compile(
        sceneOf({{filled(scene::rectangle({0, 0}, {100, 100}), scene::Color{0, 0, 1, 1})}, {choice}}));
    EXPECT_TRUE(result.warnings.empty());
    expectColor(result, {50, 40}, {1, 0, 0, 1});
    expectColor(result, {50, 60}, {0, 0, 1, 1});
    expectColor(result, {10, 50}, {0, 0.5, 0.5, 1});
}

TEST(PaperRow5, GradientsFillRegions) {
    scene::LinearGradient gradient{
        {0, 0}, {100, 0}, {{0, {0, 0, 0, 1}}, {1, {1, 1, 1, 1}}}, {}, scene::identity};
    const CompileResult result = compile(sceneOf({{filled(disc({50, 50}, 40), gradient)}}));
    expectColor(result, {25, 50}, {0.25, 0.25, 0.25, 1});
}

TEST(PaperRow5, MaterialsFillRegions) {
    const scene::Material plain{"plain", "vec4 plain(vec2 p) { return vec4(1); }", {1, 1, 0, 1}};
    const CompileResult result = compile(sceneOf({{filled(disc({50, 50}, 40), plain)}}));
    EXPECT_EQ(result.asset.palette.materials.size(), 1u);
    expectColor(result, {50, 50}, {1, 1, 0, 1});  // where no GLSL runs
}

TEST(PaperRow5, WhatTheModelCannotSayIsNamed) {
    scene::Group blended, masked;
    blended.blend = scene::BlendMode::Multiply;
    blended.children = {{filled(disc({50, 50}, 20))}};
    masked.mask = std::make_shared<scene::Mask>(scene::Mask{std::make_shared<scene::Group>(), {}, false});
    masked.children = blended.children;
    scene::Pattern pattern{{0, 0}, {5, 5}, std::make_shared<scene::Group>(), scene::identity};
    const CompileResult result =
        compile(sceneOf({{blended}, {masked}, {filled(disc({50, 50}, 20), pattern)}}));
    std::string all;
    for (const std::string& warning : result.warnings)
        all += warning + "\n";
    for (const char* what : {"blend modes (1)", "masks by luminance or alpha (1)", "patterns (1)"})
        EXPECT_NE(all.find(what), std::string::npos) << what << " in\n" << all;
}

TEST(PaperRow5, NestingBeyondTheShadersListIsALimit) {
    scene::Node node{filled(disc({50, 50}, 20))};
    for (unsigned i = 0; i <= maxPending; ++i) {
        scene::Group group;
        group.opacity = 0.9f;
        group.children = {{filled(disc({50, 50}, 10))}, node};
        node.value = group;
    }
    EXPECT_THROW(compile(sceneOf({node})), compiler::LimitError);
}

// ---- Rows 8, 9 ----------------------------------------------------------------------------------

Path star(Point centre, double radius) {
    std::vector<Point> points;
    for (int i = 0; i < 10; ++i) {
        const double angle = std::numbers::pi * i / 5, r = i % 2 == 0 ? radius : 0.4 * radius;
        points.push_back(centre + r * Point(std::cos(angle), std::sin(angle)));
    }
    return scene::polygon(points);
}

TEST(PaperRow8, TheTreeIsSmallerThanTheGrid) {
    // A sheet of nine shapes, as a font is one: corners want fine cells, all else coarse ones.
    Path sheet;
    for (int i = 0; i < 9; ++i)
        sheet = joined(sheet, star({18.3 + 31 * (i % 3), 17.9 + 32 * (i / 3)}, 13));
    const CompileResult result = compiled(filled(sheet));
    const Summary summary = summarize(result.asset);
    EXPECT_EQ(result.approximatedCells(), 0u);
    EXPECT_LE(7 * summary.treeBytes, summary.gridBytes) << "7.9 here; the paper has 8 for its font";
}

TEST(PaperRow8, DepthIsBounded) {
    CompileOptions options;
    for (const unsigned depth : {0u, 1u, 2u}) {
        options.maxDepth = depth;
        const CompileResult result = compiled(filled(disc({50, 50}, 45)), options);
        Cost cost;
        maskCoverage(maskOf(result), {50 + 45 * std::sqrt(0.5), 50 + 45 * std::sqrt(0.5)}, sharp, cost);
        EXPECT_LE(cost.indirections, depth);
    }
}

TEST(PaperRow9, TheInteriorIsSolid) {
    const CompileResult result = compiled(filled(disc({50, 50}, 45)));
    Cost cost;
    EXPECT_EQ(maskCoverage(maskOf(result), {50, 50}, sharp, cost), 1);
    EXPECT_EQ(cost.cells, 0u);
}

// ---- Row 7 --------------------------------------------------------------------------------------

TEST(PaperRow7, TheMipHoldsAreas) {
    const CompileResult result = compiled(filled(disc({50, 50}, 30)));
    const Mask& mask = maskOf(result);
    const double share = std::numbers::pi * 900 / (mask.side * mask.side);
    EXPECT_NEAR(mask.mip.texels.back() / 255.0, share, 1.0 / 255);
    double sum = 0;
    const std::size_t base = std::size_t(1) << (2 * mask.mip.sizeLog2);
    for (std::size_t i = 0; i < base; ++i)
        sum += mask.mip.texels[i] / 255.0;
    EXPECT_NEAR(sum / double(base), share, 1e-3);
}

// ---- Row 16 -------------------------------------------------------------------------------------

TEST(PaperRow16, AChangedShapeTouchesItsOwnMaskOnly) {
    const scene::Item still = filled(disc({30, 50}, 20)),
                      moving = filled(disc({70, 50}, 20), scene::Color{0, 1, 0, 1});
    const scene::Item moved =
        filled(scene::polygon({{60, 40}, {90, 40}, {75, 80}}), scene::Color{0, 1, 0, 1});
    CompileResult result = compile(sceneOf({{still}, {moving}}));
    const asset::Node* nodes = maskOf(result, 0).nodes.data();
    const std::vector<Node> before = result.asset.nodes;
    rebuildMask(result, 1, moved);
    EXPECT_EQ(maskOf(result, 0).nodes.data(), nodes) << "not even copied";
    EXPECT_EQ(result.asset.nodes.size(), before.size());
    const CompileResult anew = compile(sceneOf({{still}, {moved}}));
    const asset::View view{50, 50, {0.5, 0, 0, 0.5, 0, 0}};
    EXPECT_EQ(evaluate(result.asset, view).rgba, evaluate(anew.asset, view).rgba);
    EXPECT_THROW(rebuildMask(result, 2, moved), std::out_of_range);
}

TEST(PaperRow16, BoundsFollowTheShape) {
    std::vector<scene::Node> nodes;
    for (int i = 0; i < 20; ++i)
        nodes.push_back({filled(disc({5 + 4.0 * i, 10}, 2))});
    CompileResult result = compile(sceneOf(nodes));
    ASSERT_FALSE(result.bounded.empty());
    const scene::Item moved = filled(disc({60, 80}, 6), scene::Color{0, 1, 0, 1});
    rebuildMask(result, 3, moved);
    expectColor(result, {60, 80}, {1, 0, 0, 1});  // paints stay
    expectColor(result, {17, 10}, {0, 0, 0, 0});
}

TEST(PaperRow16, ShapesMayLeaveThePictureAndComeBack) {
    const scene::Item here = filled(disc({50, 50}, 20)), away = filled(disc({500, 50}, 20));
    CompileResult result = compile(sceneOf({{away}}));
    expectColor(result, {50, 50}, {0, 0, 0, 0});
    rebuildMask(result, 0, here);
    expectColor(result, {50, 50}, {1, 0, 0, 1});
}

TEST(PaperRow16, WhatCoversThePictureHasNoMask) {
    const scene::Item ground = filled(scene::rectangle({-1, 0}, {100, 100}));
    CompileResult result = compile(sceneOf({{ground}}));
    EXPECT_THROW(rebuildMask(result, 0, filled(disc({50, 50}, 20))), std::invalid_argument);
}

// ---- Shapes that cover the picture ----------------------------------------------------------------

const Path all = scene::rectangle({0, 0}, {side, side});
const scene::Color yellow{1, 1, 0, 1}, blue{0, 0, 1, 1}, green{0, 1, 0, 1}, red{1, 0, 0, 1};

scene::Group groupOf(std::vector<scene::Node> nodes) {
    scene::Group group;
    group.children = std::move(nodes);
    return group;
}

scene::Select selectOf(const Path& shape, const scene::Node& inside, const scene::Node& outside) {
    scene::Select select;
    select.mask = {std::make_shared<const Path>(shape), scene::identity, FillRule::NonZero};
    select.inside = std::make_shared<const scene::Group>(groupOf({inside}));
    select.outside = std::make_shared<const scene::Group>(groupOf({outside}));
    return select;
}

TEST(PaperRow5, ThreeSelectionsAmongFourPaintsAreThreeMasks) {
    const scene::Select inner = selectOf(disc({40, 50}, 10), {filled(all, red)}, {filled(all, yellow)}),
                        outer = selectOf(scene::rectangle({70, 10}, {90, 90}), {filled(all, blue)},
                                         {filled(all, green)});
    const CompileResult result = compile(sceneOf({{selectOf(disc({40, 50}, 30), {inner}, {outer})}}));
    EXPECT_EQ(result.asset.masks.size(), 3u);
    EXPECT_EQ(result.asset.nodes.size(), 3u);
    expectColor(result, {40, 50}, {1, 0, 0, 1});
    expectColor(result, {20, 50}, {1, 1, 0, 1});
    expectColor(result, {80, 50}, {0, 0, 1, 1});
    expectColor(result, {5, 5}, {0, 1, 0, 1});
}

TEST(Covering, HidesWhatLiesBelowIfItIsOpaque) {
    const CompileResult result = compile(
        sceneOf({{filled(disc({50, 50}, 20))}, {filled(all, blue)}, {filled(disc({20, 20}, 5), red)}}));
    EXPECT_EQ(result.asset.root, result.asset.nodes.size() - 1);
    EXPECT_EQ(result.maskOfItem[1], noIndex);
    Cost cost;
    evaluate(result.asset, {10, 10, {0.1, 0, 0, 0.1, 0, 0}}, &cost);
    EXPECT_EQ(cost.nodes, 100u);
    expectColor(result, {50, 50}, {0, 0, 1, 1});
    expectColor(result, {20, 20}, {1, 0, 0, 1});
}

/// Beside the same shapes with a speck outside, which makes them masks.
TEST(Covering, DrawsWhatAMaskDraws) {
    const auto sceneWith = [](const Path& cover) {
        scene::Item faint = filled(cover, scene::Color{0, 0, 1, 0.5f}), half = filled(cover, green);
        half.opacity = 0.25f;
        scene::Group group = groupOf({{filled(cover, yellow)}, {filled(disc({60, 60}, 15))}});
        group.opacity = 0.5f;
        scene::Group clipped = groupOf({{filled(cover, red)}, {faint}});
        auto clip = std::make_shared<scene::Clip>();
        clip->shapes.push_back(
            {std::make_shared<const Path>(disc({30, 30}, 20)), scene::identity, FillRule::NonZero, nullptr});
        clipped.clip = clip;
        std::vector<scene::Node> nodes{{filled(disc({50, 50}, 30))}, {faint}, {group}, {clipped}, {half}};
        for (int i = 0; i < 8; ++i)
            nodes.push_back({filled(disc({10.0 + 10 * i, 80}, 6), blue)});
        nodes.insert(nodes.begin() + 7, {faint});
        return sceneOf(nodes);
    };
    // A hole of no area in the middle of the picture keeps the mask.
    const Path pierced = joined(scene::rectangle({-50, -50}, {150, 150}),
                                scene::polygon({{1, 1}, {1.001, 1}, {1.001, 1.001}}));
    const CompileResult without = compile(sceneWith(scene::rectangle({-50, -50}, {150, 150}))),
                        with = compile(sceneWith(pierced));
    EXPECT_LT(without.asset.masks.size(), with.asset.masks.size());
    const asset::View view{60, 60, {1, 0, 0, 1, -30, -30}};
    const image::Raster a = evaluate(without.asset, view), b = evaluate(with.asset, view);
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        ASSERT_NEAR(a.rgba[i], b.rgba[i], 1e-5) << i / 4 % 60 << ", " << i / 240;
}

// ---- Options ------------------------------------------------------------------------------------

TEST(CompileOptions, OutOfRangeIsRefused) {
    CompileOptions options;
    options.tolerance = 1;
    EXPECT_THROW(compile(sceneOf({}), options), std::invalid_argument);
    options = {};
    options.maxDepth = 9;
    EXPECT_THROW(compile(sceneOf({}), options), std::invalid_argument);
    options = {};
    options.mipLog2 = 11;
    EXPECT_THROW(compile(sceneOf({}), options), std::invalid_argument);
}

TEST(CompileOptions, EmptyAndFlatShapesDrawNothing) {
    const CompileResult result = compile(sceneOf({{filled({})},
                                                  {filled(scene::polygon({{10, 10}, {90, 10}}))},
                                                  {filled(disc({50, 50}, 20), scene::Color{0, 0, 0, 0})}}));
    for (double x = 1; x < side; x += 7)
        expectColor(result, {x, 10}, {0, 0, 0, 0});
}

}  // namespace
}  // namespace vtm::paper

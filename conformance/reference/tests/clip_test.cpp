/// Clips and masks.

#include "conformance/reference/tests/scenes.hpp"

namespace vtm::reference {

namespace {

ClipShape clipShape(Path path, std::shared_ptr<const Clip> clip = nullptr) {
    return {share(std::move(path)), identity, FillRule::NonZero, std::move(clip)};
}

std::shared_ptr<const Clip> clipOf(std::vector<ClipShape> shapes,
                                   std::shared_ptr<const Clip> clip = nullptr) {
    return std::make_shared<const Clip>(Clip{std::move(shapes), std::move(clip)});
}

Group clipped(std::vector<Node> nodes, std::shared_ptr<const Clip> clip) {
    Group result = group(std::move(nodes));
    result.clip = std::move(clip);
    return result;
}

Group masked(std::vector<Node> nodes, Group content, MaskKind kind, bool linear = false) {
    Group result = group(std::move(nodes));
    result.mask =
        std::make_shared<const Mask>(Mask{std::make_shared<const Group>(std::move(content)), kind, linear});
    return result;
}

class Clipping : public BothModes {};
class Masking : public BothModes {};
constexpr auto modeName = [](const auto& mode) { return mode.param == Mode::Exact ? "Exact" : "Compat"; };
INSTANTIATE_TEST_SUITE_P(Render, Clipping, testing::Values(Mode::Exact, Mode::Compat), modeName);
INSTANTIATE_TEST_SUITE_P(Render, Masking, testing::Values(Mode::Exact, Mode::Compat), modeName);

TEST_P(Clipping, CutsWithPartialPixels) {
    const auto raster =
        draw(sceneOf({{clipped({{fillAll(red)}}, clipOf({clipShape(rectangle({1, 1}, {3.5, 3}))}))}}));
    expectPixel(raster, 2, 2, {1, 0, 0, 1});
    expectPixel(raster, 3, 2, {0.5, 0, 0, 0.5});
    expectPixel(raster, 4, 2, {0, 0, 0, 0});
    expectPixel(raster, 2, 3, {0, 0, 0, 0});
}

TEST_P(Clipping, UnitesItsShapes) {
    const auto clip = clipOf({clipShape(rectangle({0, 0}, {3, 3})), clipShape(rectangle({2, 2}, {6, 6}))});
    const auto raster = draw(sceneOf({{clipped({{fillAll(red)}}, clip)}}));
    expectPixel(raster, 1, 1, {1, 0, 0, 1});
    expectPixel(raster, 2, 2, {1, 0, 0, 1});
    expectPixel(raster, 5, 5, {1, 0, 0, 1});
    expectPixel(raster, 5, 1, {0, 0, 0, 0});
}

TEST_P(Clipping, EmptyUnionClipsEverything) {
    const auto raster = draw(sceneOf({{clipped({{fillAll(red)}}, clipOf({}))}}));
    for (const float v : raster.rgba)
        EXPECT_EQ(v, 0);
}

TEST_P(Clipping, ShapesAndClipsAreClippedThemselves) {
    const auto left = clipOf({clipShape(rectangle({0, 0}, {4, 8}))});
    const auto top = clipOf({clipShape(rectangle({0, 0}, {8, 4}))});
    // (all of it, cut to the left half) or the lower right corner, and all of that cut to the top.
    const auto clip =
        clipOf({clipShape(rectangle({0, 0}, {8, 8}), left), clipShape(rectangle({6, 2}, {8, 8}))}, top);
    const auto raster = draw(sceneOf({{clipped({{fillAll(red)}}, clip)}}));
    expectPixel(raster, 1, 1, {1, 0, 0, 1});
    expectPixel(raster, 5, 1, {0, 0, 0, 0});
    expectPixel(raster, 7, 3, {1, 0, 0, 1});
    expectPixel(raster, 7, 5, {0, 0, 0, 0});
    expectPixel(raster, 1, 5, {0, 0, 0, 0});
}

TEST_P(Clipping, EvenOddRuleAndTransform) {
    Path ring = rectangle({0, 0}, {4, 4});
    const Path hole = rectangle({1, 1}, {3, 3});
    ring.insert(ring.end(), hole.begin(), hole.end());
    ClipShape shape = clipShape(ring);
    shape.rule = FillRule::EvenOdd;
    shape.transform = scaling(2, 2);
    const auto raster = draw(sceneOf({{clipped({{fillAll(red)}}, clipOf({shape}))}}));
    expectPixel(raster, 1, 1, {1, 0, 0, 1});
    expectPixel(raster, 4, 4, {0, 0, 0, 0});
}

TEST(Clipping, ExactModeKnowsThatEdgesCoincide) {
    const Path half = rectangle({0, 0}, {2.5, 8});
    const Scene scene = sceneOf({{clipped({{fill(half, red)}}, clipOf({clipShape(half)}))}});
    expectPixel(renderAt(scene, Mode::Exact), 2, 2, {0.5, 0, 0, 0.5});
    expectPixel(renderAt(scene, Mode::Compat), 2, 2, {0.25, 0, 0, 0.25});
}

TEST_P(Masking, LuminanceTimesAlpha) {
    const Group content = group({{fill(rectangle({0, 0}, {2, 8}), white)},
                                 {fill(rectangle({2, 0}, {4, 8}), green)},
                                 {fill(rectangle({4, 0}, {6, 8}), Color{0.5f, 0.5f, 0.5f, 0.5f})}});
    const auto raster = draw(sceneOf({{masked({{fillAll(blue)}}, content, MaskKind::Luminance)}}));
    expectPixel(raster, 1, 1, {0, 0, 1, 1});
    expectPixel(raster, 3, 1, {0, 0, 0.7152, 0.7152});
    expectPixel(raster, 5, 1, {0, 0, 0.25, 0.25});
    expectPixel(raster, 7, 1, {0, 0, 0, 0});
}

TEST_P(Masking, LinearLightAndAlpha) {
    const Group content = group({{fillAll(Color{0.5f, 0.5f, 0.5f, 0.5f})}});
    // ((0.5 + 0.055) / 1.055)^2.4 = 0.2140411
    expectPixel(draw(sceneOf({{masked({{fillAll(blue)}}, content, MaskKind::Luminance, true)}})), 3, 3,
                {0, 0, 0.5 * 0.2140411, 0.5 * 0.2140411});
    expectPixel(draw(sceneOf({{masked({{fillAll(blue)}}, content, MaskKind::Alpha)}})), 3, 3,
                {0, 0, 0.5, 0.5});
}

TEST_P(Masking, MasksMaskMasks) {
    const Group inner =
        masked({{fillAll(white)}}, group({{fill(rectangle({0, 0}, {4, 8}), white)}}), MaskKind::Alpha);
    const Group content = group({{fill(rectangle({0, 0}, {8, 4}), white, 0.5f)}, {inner}});
    const auto raster =
        draw(sceneOf({{fillAll(red)}, {masked({{fillAll(blue)}}, content, MaskKind::Alpha)}}));
    expectPixel(raster, 1, 6, {0, 0, 1, 1});
    expectPixel(raster, 6, 1, {0.5, 0, 0.5, 1});
    expectPixel(raster, 6, 6, {1, 0, 0, 1});
}

TEST_P(Masking, ClipMaskAndOpacityMultiply) {
    Group all = masked({{fillAll(red)}}, group({{fillAll(Color{0, 0, 0, 0.5f})}}), MaskKind::Alpha);
    all.clip = clipOf({clipShape(rectangle({0, 0}, {2.5, 8}))});
    all.opacity = 0.5;
    const auto raster = draw(sceneOf({{all}}));
    expectPixel(raster, 1, 1, {0.25, 0, 0, 0.25});
    expectPixel(raster, 2, 1, {0.125, 0, 0, 0.125});
    expectPixel(raster, 3, 1, {0, 0, 0, 0});
}

}  // namespace

/// Selections: one of two pictures at every point.

namespace {

std::shared_ptr<const Group> side(std::vector<Node> nodes) {
    return std::make_shared<const Group>(group(std::move(nodes)));
}

Select select(Path mask, std::shared_ptr<const Group> inside, std::shared_ptr<const Group> outside) {
    return {{share(std::move(mask)), identity, FillRule::NonZero}, std::move(inside), std::move(outside)};
}

class Selecting : public BothModes {};
INSTANTIATE_TEST_SUITE_P(Render, Selecting, testing::Values(Mode::Exact, Mode::Compat),
                         [](const auto& mode) { return mode.param == Mode::Exact ? "Exact" : "Compat"; });

TEST_P(Selecting, SharesOfAPixelAddUp) {
    const auto raster = draw(
        sceneOf({{select(rectangle({0, 0}, {3.25, 8}), side({{fillAll(red)}}), side({{fillAll(blue)}}))}}));
    expectPixel(raster, 2, 2, {1, 0, 0, 1});
    expectPixel(raster, 3, 2, {0.25, 0, 0.75, 1});
    expectPixel(raster, 4, 2, {0, 0, 1, 1});
}

TEST_P(Selecting, ATranslucentInsideShowsTheGroundAndNotTheOutside) {
    const auto raster = draw(
        sceneOf({{fillAll(green)},
                 {select(rectangle({0, 0}, {4, 8}), side({{fillAll(red, 0.5)}}), side({{fillAll(blue)}}))}}));
    expectPixel(raster, 1, 1, {0.5, 0.5, 0, 1});
    expectPixel(raster, 6, 1, {0, 0, 1, 1});
}

TEST_P(Selecting, ASideThatIsMissingIsTransparent) {
    const auto raster =
        draw(sceneOf({{select(rectangle({0, 0}, {4, 8}), nullptr, side({{fillAll(red)}}))},
                      {select(rectangle({6, 0}, {8, 8}), side({{fillAll(blue)}}), nullptr)}}));
    expectPixel(raster, 1, 1, {0, 0, 0, 0});
    expectPixel(raster, 5, 1, {1, 0, 0, 1});
    expectPixel(raster, 7, 1, {0, 0, 1, 1});
}

TEST_P(Selecting, NestsOnBothSidesWithTheMasksOfStrokes) {
    StrokeStyle pen;
    pen.width = 2;
    const Shape line{share({MoveTo{{0, 4}}, LineTo{{8, 4}}}), identity, pen};
    const Select inner = select(rectangle({0, 0}, {4, 8}), side({{fillAll(red)}}), side({{fillAll(green)}}));
    const Select outer{line, side({{inner}}), side({{fillAll(blue)}, {inner}})};
    const auto raster = draw(sceneOf({{outer}}));
    expectPixel(raster, 1, 4, {1, 0, 0, 1});
    expectPixel(raster, 6, 4, {0, 1, 0, 1});
    expectPixel(raster, 6, 1, {0, 1, 0, 1});
    const auto shifted = draw(sceneOf({{Select{line, side({{inner}}), side({{fillAll(blue)}})}}}));
    expectPixel(shifted, 6, 1, {0, 0, 1, 1});
}

TEST_P(Selecting, WorksInTilesAndMasks) {
    auto content =
        side({{select(rectangle({0, 0}, {2, 4}), side({{fillAll(red)}}), side({{fillAll(white)}}))}});
    const auto tiled = draw(sceneOf({{fillAll(Pattern{{0, 0}, {4, 4}, content, identity})}}));
    expectPixel(tiled, 5, 5, {1, 0, 0, 1});
    expectPixel(tiled, 7, 5, {1, 1, 1, 1});
    Group masked = group({{fillAll(blue)}});
    masked.mask = std::make_shared<const Mask>(Mask{content, MaskKind::Luminance, false});
    const auto raster = draw(sceneOf({{masked}}));
    expectPixel(raster, 1, 1, {0, 0, 0.2126, 0.2126});
    expectPixel(raster, 3, 1, {0, 0, 1, 1});
}

}  // namespace

}  // namespace vtm::reference

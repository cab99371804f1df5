/// Selections: one of two pictures at every point.
#include "conformance/reference/tests/scenes.hpp"

namespace vtm::reference {
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

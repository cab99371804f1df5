#include "conformance/runner/judge/judge.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "conformance/runner/judge/faults.hpp"
#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {

namespace {

using image::Raster;

constexpr float unit = 1.0f / 255;

/// White on the left of column 10, black from there on; a soft column between.
Raster edge() {
    Raster picture(24, 24);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const float value = x < 10 ? 1 : x == 10 ? 0.4f : 0;
            std::fill_n(picture.pixel(x, y), 3, value);
            picture.pixel(x, y)[3] = 1;
        }
    return picture;
}

TEST(Measure, EveryBoundCanBreak) {
    Raster drawn = edge();
    drawn.pixel(10, 5)[0] += 3 * unit;
    EXPECT_EQ(measure(edge(), drawn, {.max = 3.1}).broken, "");
    for (const Bounds& bounds :
         {Bounds{.max = 2.9}, Bounds{.mean = 1e-4}, Bounds{.rms = 1e-3}, Bounds{.max = 0, .flat = 0}})
        EXPECT_NE(measure(edge(), drawn, bounds).broken, "");
    EXPECT_EQ(measure(edge(), drawn, {.p999 = 0}).broken, "");  // one value in 2304
    drawn.pixel(10, 6)[0] += 3 * unit, drawn.pixel(10, 7)[0] += 3 * unit;
    EXPECT_NE(measure(edge(), drawn, {.p999 = 0}).broken, "");
}

/// A seam is seen where neighbours are alike, and errors of edges are no seams.
TEST(Measure, FlatLooksAwayFromEdges) {
    Raster atEdge = edge(), inside = edge();
    atEdge.pixel(10, 5)[0] += 9 * unit;
    inside.pixel(17, 5)[0] += 2 * unit;
    EXPECT_EQ(measure(edge(), atEdge, {.flat = 1}).broken, "");
    EXPECT_NE(measure(edge(), inside, {.flat = 1}).broken, "");
}

TEST(Measure, NotANumberBreaksEveryBound) {
    Raster drawn = edge();
    drawn.pixel(17, 5)[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(measure(edge(), drawn, {.max = 200}).broken, "");
    EXPECT_NE(measure(edge(), drawn, {.flat = 200}).broken, "");
}

TEST(Measure, AnotherSizeBreaks) { EXPECT_NE(measure(edge(), Raster(24, 23), {}).broken, ""); }

/// Draws what it is told to.
class Fake : public Subject {
public:
    Raster asset = edge(), gl = edge();
    Bounds limits{.max = 4, .twin = 2};

    std::size_t views() const override { return 2; }
    std::string labelOf(std::size_t view) const override { return view == 0 ? "first" : "second"; }
    std::vector<Engine> engines(std::size_t) const override { return {Engine::Gl, Engine::Asset}; }
    Bounds bounds(Engine) const override { return limits; }
    Raster expected(std::size_t) override { return edge(); }
    Raster drawn(std::size_t view, Engine engine) override {
        return view == 0 ? edge() : engine == Engine::Gl ? gl : asset;
    }
};

TEST(Judge, PassesWhatIsWithinBounds) {
    Fake subject;
    const Outcome outcome = judge(subject, {});
    EXPECT_EQ(outcome.status, Outcome::Status::Passed);
    EXPECT_EQ(outcome.figures.size(), 2u);
    EXPECT_FALSE(outcome.pictures);
}

TEST(Judge, NamesEngineAndViewAndKeepsThePictures) {
    Fake subject;
    subject.asset.pixel(3, 3)[1] = 0;
    const Outcome outcome = judge(subject, {});
    EXPECT_EQ(outcome.status, Outcome::Status::Failed);
    EXPECT_NE(outcome.message.find("asset, second: max 255"), std::string::npos) << outcome.message;
    ASSERT_TRUE(outcome.pictures);
    EXPECT_EQ(outcome.pictures->engine, "asset");
}

/// Each within 4 of the truth, but 6 from each other.
TEST(Judge, TwinsThatDifferFail) {
    Fake subject;
    subject.asset.pixel(3, 3)[1] -= 3 * unit;
    subject.gl.pixel(3, 3)[1] += 3 * unit;
    EXPECT_NE(judge(subject, {}).message.find("gl, second: 6"), std::string::npos);
}

TEST(Judge, WithoutAnEngineToAskSkips) {
    Fake subject;
    EXPECT_EQ(judge(subject, {.engines = {Engine::Scan}}).status, Outcome::Status::Skipped);
}

}  // namespace

// The comparator's own test: on cases of every picture suite, each mistake must be seen, and no mistake none.

namespace {

const std::vector<Case>& cases() {
    static const std::vector<Case> all = [] {
        std::vector<Case> chosen;
        const auto folder = std::filesystem::path(VTM_SOURCE_DIR) / "conformance/suites";
        for (const char* suite : {"coverage", "regions"})
            for (Case& one : loadSuite(folder / suite))
                for (const char* name : {"coverage.polygons.arrow.nonzero", "coverage.curves.blob.evenodd",
                                         "coverage.strokes.smooth.wave.width10.butt.solid",
                                         "regions.grid-colours.on-nothing", "regions.translucent-5.on-white"})
                    if (one.name == name)
                        chosen.push_back(std::move(one));
        return chosen;
    }();
    return all;
}

class Faults : public testing::TestWithParam<Fault> {};

std::string nameOfTest(const testing::TestParamInfo<Fault>& info) {
    std::string name(nameOf(info.param));
    std::ranges::replace(name, '-', '_');
    return name;
}

/// Layers differ from regions only where shapes meet.
std::vector<Fault> faultsOfAnyPicture() {
    std::vector<Fault> faults = allFaults();
    std::erase(faults, Fault::Layers);
    return faults;
}

INSTANTIATE_TEST_SUITE_P(Every, Faults, testing::ValuesIn(faultsOfAnyPicture()), nameOfTest);

TEST_P(Faults, AreSeenByEveryCase) {
    ASSERT_EQ(cases().size(), 5u);
    for (const Case& one : cases()) {
        const Outcome outcome = one.run({.fault = GetParam()});
        EXPECT_EQ(outcome.status, Outcome::Status::Failed) << one.name;
    }
}

/// Blended layers let a quarter of the ground through where each covers half a pixel.
TEST(Fault, LayersAreSeenAtSeams) {
    for (const Case& one : cases())
        if (one.name == "regions.grid-colours.on-nothing") {
            const Outcome outcome = one.run({.fault = Fault::Layers});
            ASSERT_EQ(outcome.figures.size(), 1u);
            EXPECT_GT(outcome.figures[0].difference.max, 40) << one.name;
        }
}

TEST(Fault, OfNoKindFailNothing) {
    ASSERT_EQ(cases().size(), 5u);
    for (const Case& one : cases()) {
        const Outcome outcome = one.run({});
        EXPECT_EQ(outcome.status, Outcome::Status::Passed) << one.name << ": " << outcome.message;
    }
}

TEST(Fault, HaveNames) {
    for (const Fault fault : allFaults())
        EXPECT_EQ(faultOf(nameOf(fault)), fault);
    EXPECT_THROW(faultOf("nonsense"), std::runtime_error);
}

}  // namespace

}  // namespace vtm::conformance

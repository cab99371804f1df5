// The comparator's own test: on cases of every picture suite, each mistake must be seen, and no mistake none.

#include "conformance/runner/judge/faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {
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

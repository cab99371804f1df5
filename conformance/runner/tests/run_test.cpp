#include "conformance/runner/run.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace vtm::conformance {
namespace {

Case caseOf(const std::string& name, Outcome outcome) {
    return {name, "file", "about", [=](const Setting&) { return outcome; }};
}

std::vector<Row> runThem(std::vector<Expectation> expectations = {}, unsigned jobs = 1) {
    const std::vector<Case> cases{
        caseOf("a.good", Outcome::passed()),
        caseOf("a.bad", Outcome::failed("wrong")),
        caseOf("b.absent", Outcome::skipped("no data")),
        {"b.thrown", "file", "about", [](const Setting&) -> Outcome { throw std::runtime_error("broken"); }}};
    return run(cases, {{}, jobs, std::move(expectations), {}});
}

TEST(Run, GivesEachCaseItsVerdict) {
    const std::vector<Row> rows = runThem();
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].verdict, Verdict::Passed);
    EXPECT_EQ(rows[1].verdict, Verdict::Failed);
    EXPECT_EQ(rows[2].verdict, Verdict::Skipped);
    EXPECT_EQ(rows[3].message, "threw: broken");
    EXPECT_EQ(rows[3].suite, "b");
    const Summary summary = summarize(rows);
    EXPECT_EQ(summary.passed, 1u);
    EXPECT_EQ(summary.failed, 2u);
    EXPECT_EQ(summary.skipped, 1u);
}

TEST(Run, IsTheSameInManyJobs) {
    const std::vector<Row> one = runThem(), many = runThem({}, 4);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].name, many[i].name);
        EXPECT_EQ(one[i].verdict, many[i].verdict);
    }
}

TEST(Run, ExpectedFailuresAreNoFailures) {
    const std::vector<Row> rows = runThem({{"a.bad", "known"}});
    EXPECT_EQ(rows[1].verdict, Verdict::ExpectedFailure);
    EXPECT_EQ(rows[1].message, "known | wrong");
}

TEST(Run, AnExpectedFailureThatPassesIsAFailure) {
    EXPECT_EQ(runThem({{"a.good", "known"}})[0].verdict, Verdict::Failed);
}

TEST(MustPass, NamesWhatDidNot) {
    const std::vector<Row> rows = runThem({{"a.bad", "known"}});
    EXPECT_TRUE(missedMustPass(rows, {"a.good"}, true).empty());
    EXPECT_EQ(missedMustPass(rows, {"a"}, true).size(), 1u);
    EXPECT_EQ(missedMustPass(rows, {"b.absent"}, true).size(), 1u);
    EXPECT_EQ(missedMustPass(rows, {"c.*"}, true).size(), 1u);
    EXPECT_TRUE(missedMustPass(rows, {"c.*"}, false).empty());
}

}  // namespace
}  // namespace vtm::conformance

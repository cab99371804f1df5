#include "conformance/runner/run.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/runner/report/report.hpp"
#include "conformance/runner/suite/suite.hpp"
#include "tests/test_folder.hpp"

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

namespace fs = std::filesystem;

class ReportTest : public testing::Test {
protected:
    ReportTest() {
        Row good, bad;
        good.name = "a.good", good.suite = "a";
        bad.name = "b.bad", bad.suite = "b", bad.verdict = Verdict::Failed;
        bad.message = "<\"&\x01</script>";
        Figure figure;
        figure.difference.max = infinite;
        bad.outcome.figures = {figure};
        bad.outcome.pictures = Pictures{"gl", "first", image::Raster(4, 3), image::Raster(4, 3)};
        rows_ = {good, bad};
    }
    const TestFolder folder_;
    std::vector<Row> rows_;
    static constexpr double infinite = std::numeric_limits<double>::infinity();
};

TEST_F(ReportTest, JsonHasASummaryAndARowACase) {
    const fs::path file = folder_ / "rows.json";
    writeJson(file, rows_);
    const auto json = nlohmann::json::parse(readText(file));
    EXPECT_EQ(json["summary"],
              (nlohmann::json{{"passed", 1}, {"failed", 1}, {"skipped", 0}, {"expected_failures", 0}}));
    EXPECT_EQ(json["cases"][1]["message"], rows_[1].message);
    EXPECT_EQ(json["cases"][1]["worst"][0]["max"], "infinite");
}

TEST_F(ReportTest, JunitEscapesAndCounts) {
    const fs::path file = folder_ / "rows.xml";
    writeJunit(file, rows_);
    const std::string text = readText(file);
    EXPECT_NE(text.find("<testsuite name=\"b\" tests=\"1\" failures=\"1\""), std::string::npos) << text;
    EXPECT_NE(text.find("&lt;&quot;&amp;?&lt;/script>"), std::string::npos) << text;
}

TEST_F(ReportTest, PageHoldsAllItNeeds) {
    const Report report(folder_.path());
    report.addPictures(rows_[1]);
    EXPECT_FALSE(rows_[1].outcome.pictures);
    ASSERT_EQ(rows_[1].pictures.size(), 4u);
    for (const std::string& picture : rows_[1].pictures)
        EXPECT_TRUE(fs::exists(folder_ / picture)) << picture;
    report.writePage(rows_);
    const std::string page = readText(folder_ / "index.html");
    EXPECT_NE(page.find("b.bad.heat.png"), std::string::npos);
    for (const char* outside : {"http:", "https:", "src=\"//", "@import"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    EXPECT_EQ(page.find("</script>"), page.rfind("</script>"));  // the data do not end the script
}

}  // namespace

}  // namespace vtm::conformance

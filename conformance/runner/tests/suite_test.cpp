#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "conformance/runner/suite/expectations.hpp"
#include "conformance/runner/suite/suite.hpp"
#include "conformance/runner/suite/views.hpp"
#include "tests/test_folder.hpp"

namespace vtm::conformance {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> namesOf(const std::vector<Variant>& variants) {
    std::vector<std::string> names;
    for (const Variant& variant : variants)
        names.push_back(variant.name);
    return names;
}

TEST(Variants, AreProductsOfAxesAndUnionsOfSets) {
    const Settings settings = Settings::parse(R"({"variants": [
        [{"a": "x: 1", "b": ""}, {"c": "y: 2", "d": {"views": {"count": 3}}}], [{"e": ""}]]})");
    const auto variants = variantsOf(settings);
    EXPECT_EQ(namesOf(variants), (std::vector<std::string>{"a.c", "a.d", "b.c", "b.d", "e"}));
    EXPECT_EQ(variants[0].style, "x: 1;y: 2;");
    EXPECT_EQ(variants[1].settings["views"]["count"], 3);
    EXPECT_EQ(namesOf(variantsOf(Settings::object())), std::vector<std::string>{""});
}

/// A suite of its own in a temporary folder.
class SuiteFolder : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
    }
    std::string errorOf() {
        try {
            loadSuite(folder_);
        } catch (const SuiteError& error) {
            return error.what();
        }
        return {};
    }
    const TestFolder parent_;
    const fs::path folder_ = parent_ / "mine";
    const std::string square_ =
        "<!-- A square.\n  No curves. --><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"64\" "
        "height=\"64\"><path id=\"subject\" d=\"M9,9H50V50H9Z\"/></svg>";
};

TEST_F(SuiteFolder, HasMoreCasesInFull) {
    write("suite.json", R"({"kind": "random", "hard": true, "from": 1, "count": 1, "full": {"count": 3},
                            "bounds": {"max": 4}})");
    const std::size_t daily = loadSuite(folder_).size();
    EXPECT_EQ(loadSuite(folder_, Extent::Full).size(), 3 * daily);
    EXPECT_EQ(loadSuite(folder_).front().name, "mine.slivers.seed0001");
}

TEST_F(SuiteFolder, LooksAtSizesWholeAndInPart) {
    const scene::Scene scene{100, 1, {}};
    const ViewPlan plan =
        viewPlan(nlohmann::json::parse(R"({"way": "sizes", "sizes": [8, 64], "pixels": [8, 128]})"));
    const auto views = viewsOf(plan, scene, "salt");
    ASSERT_EQ(views.size(), 4u);
    EXPECT_EQ(views[2].view.width, 64);
    EXPECT_EQ(views[2].view.height, 1);
    EXPECT_DOUBLE_EQ(views[2].view.toPixels[0].x, 0.64);
    EXPECT_DOUBLE_EQ(views[2].view.toPixels[1].y, 1);
    EXPECT_EQ(views[3].view.width, 64);
    EXPECT_EQ(views[3].view.height, 64);
}

TEST_F(SuiteFolder, NeedsNoMoreThanFiles) {
    write("suite.json", R"({"kind": "scene", "bounds": {"max": 4}, "views": {"count": 2},
                            "variants": [[{"plain": "", "evenodd": "fill-rule: evenodd"}]]})");
    write("deep/square.svg", square_);
    const std::vector<Case> cases = loadSuite(folder_);
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[1].name, "mine.deep.square.evenodd");
    EXPECT_EQ(cases[1].about, "A square. No curves.");
    const Outcome outcome = cases[1].run({});
    EXPECT_EQ(outcome.status, Outcome::Status::Passed) << outcome.message;
}

TEST_F(SuiteFolder, TakesTextsOfTreesForPictures) {
    write("suite.json", R"({"kind": "scene", "bounds": {"max": 4}, "views": {"count": 2}})");
    write("half.vtmtree", "// A half.\n// No curves.\nvtmtree 1 size 8 8 draw select rect(0 0, 4 8) red\n");
    const std::vector<Case> cases = loadSuite(folder_);
    ASSERT_EQ(cases.size(), 1u);
    EXPECT_EQ(cases[0].name, "mine.half");
    EXPECT_EQ(cases[0].about, "A half. No curves.");
    const Outcome outcome = cases[0].run({});
    EXPECT_EQ(outcome.status, Outcome::Status::Passed) << outcome.message;
}

TEST_F(SuiteFolder, FoldersBelowChangeWhatTheyName) {
    write("suite.json", R"({"kind": "scene", "bounds": {"max": 4, "rms": 1}})");
    write("a/suite.json", R"({"bounds": {"max": 2}})");
    const std::vector<Folder> folders = foldersOf(folder_);
    ASSERT_EQ(folders.size(), 2u);
    EXPECT_EQ(folders[1].name, "mine.a");
    EXPECT_EQ(folders[1].settings["bounds"], (Settings{{"max", 2}, {"rms", 1}}));
}

TEST_F(SuiteFolder, AFileWithoutACommentIsAnError) {
    write("suite.json", R"({"kind": "scene", "bounds": {}})");
    write("bare.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    EXPECT_NE(errorOf().find("bare.svg: has no comment"), std::string::npos) << errorOf();
}

TEST_F(SuiteFolder, WhatIsUnknownIsAnErrorThatNamesIt) {
    write("square.svg", square_);
    for (const auto& [text, what] :
         {std::pair(R"({"kind": "nonsense"})", "no kind 'nonsense'"),
          {R"({"kind": "scene", "bounds": {"maxx": 1}})", "bounds: there is no 'maxx'"},
          {R"({"kind": "scene", "bounds": {}, "views": {"wey": 1}})", "views: there is no 'wey'"},
          {R"({"kind": "scene", "bounds": {}, "engines": ["glx"]})", "no engine is called 'glx'"},
          {R"({"kind": )", "suite.json: "}}) {
        write("suite.json", text);
        EXPECT_NE(errorOf().find(what), std::string::npos) << errorOf();
    }
}

TEST_F(SuiteFolder, AStyleNeedsASubject) {
    write("suite.json", R"({"kind": "scene", "bounds": {}, "variants": [[{"a": "fill: red"}]]})");
    write("bare.svg",
          "<!-- Nothing. --><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"></svg>");
    EXPECT_THROW(loadSuite(folder_).at(0).run({}), SuiteError);
}

/// What is promised of our own suites: many cases, each with a name and text of its own.
TEST(OurSuites, HoldManyCases) {
    std::set<std::string> names;
    const fs::path suites = fs::path(VTM_SOURCE_DIR) / "conformance/suites";
    for (const char* suite : {"coverage", "regions", "scale", "paper", "robustness", "random"})
        for (const Case& one : loadSuite(suites / suite)) {
            names.insert(one.name);
            EXPECT_FALSE(one.about.empty()) << one.name;
        }
    EXPECT_GE(names.size(), 1500u);
}

TEST(Matches, ANameItselfAndAllBelowIt) {
    EXPECT_TRUE(matches("coverage.stars.bowtie", "coverage.stars.bowtie"));
    EXPECT_TRUE(matches("coverage.stars.bowtie", "coverage"));
    EXPECT_FALSE(matches("coverage.stars.bowtie", "cover"));
    EXPECT_FALSE(matches("coverage.stars", "coverage.stars.bowtie"));
}

TEST(Matches, Globs) {
    EXPECT_TRUE(matches("coverage.stars.bowtie", "*.bowtie"));
    EXPECT_TRUE(matches("coverage.stars.star-5-2", "coverage.*.star-[0-9]-?"));
    EXPECT_FALSE(matches("coverage.stars.bowtie", "*.stars"));
}

class ExpectationFile : public testing::Test {
protected:
    std::filesystem::path write(const std::string& text) {
        const auto file = folder_ / "expectations.tsv";
        std::ofstream(file) << text;
        return file;
    }
    const TestFolder folder_;
};

TEST_F(ExpectationFile, HasANameAndAReasonALine) {
    const auto list = readExpectations(write("# comment\n\na.b\tnot yet\n"));
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(reasonFor("a.b", list), "not yet");
    EXPECT_EQ(reasonFor("a.b.c", list), std::nullopt);
}

TEST_F(ExpectationFile, WithoutAReasonIsAnErrorThatNamesTheLine) {
    try {
        readExpectations(write("a.b\tnot yet\na.c\n"));
        FAIL();
    } catch (const SuiteError& error) {
        EXPECT_NE(std::string(error.what()).find("expectations.tsv:2:"), std::string::npos) << error.what();
    }
}

}  // namespace

}  // namespace vtm::conformance

#include "conformance/runner/suite/expectations.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {
namespace {

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
        const auto file = std::filesystem::path(testing::TempDir()) / "expectations.tsv";
        std::ofstream(file) << text;
        return file;
    }
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

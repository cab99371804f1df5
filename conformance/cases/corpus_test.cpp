// Real files against independent ground truth, and the three engines against each other.

#include <gtest/gtest.h>

#include "conformance/cases/measure.hpp"

namespace vtm::cases {

/// For the names of the tests.
std::ostream& operator<<(std::ostream& out, const CorpusFile& file) { return out << file.name; }

namespace {

namespace fs = std::filesystem;

class Corpus : public testing::TestWithParam<CorpusFile> {
protected:
    void SetUp() override {
        if (!fs::exists(sharedDirectory() / "corpus"))
            GTEST_SKIP() << sharedDirectory() / "corpus"
                         << " is absent";
    }
};

std::string nameOf(const testing::TestParamInfo<CorpusFile>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(File, Corpus, testing::ValuesIn(corpusFiles()), nameOf);

/// Every file is drawn, those too whose picture we know to be wrong.
TEST_P(Corpus, MatchesTheTruth) {
    const CorpusFile& file = GetParam();
    Gl gl;
    const Measurement measured(file.name);
    for (const int size : {1024, 64})
        ASSERT_NO_THROW(gl.render(measured.asset(), wholePicture(measured.scene(), size)));
    bool matches = true;
    for (const CorpusFile::Limit& limit : file.limits) {
        const compare::Difference d = measured.glToTruth(gl, limit.size);
        const bool within = d.mean <= limit.mean() && d.p999 <= truthP999;
        EXPECT_TRUE(within || !file.expectedFailure.empty())
            << file.name << " at " << limit.size << " px: mean " << d.mean << " (at most " << limit.mean()
            << "), p99.9 " << d.p999 << " (at most " << truthP999 << "), worst at " << d.worstX << ", "
            << d.worstY;
        matches = matches && within;
    }
    if (!file.limits.empty()) {
        EXPECT_EQ(matches, file.expectedFailure.empty())
            << file.name << " passes now: it is no expected failure any more (" << file.expectedFailure
            << ")";
    }
}

TEST_P(Corpus, CpuEvaluatorAgrees) {
    Gl gl;
    const Measurement measured(GetParam().name);
    for (const int size : {1024, 64}) {
        const compare::Difference d = measured.glToAsset(gl, size);
        EXPECT_LE(d.max, assetMax) << size << " px, at " << d.worstX << ", " << d.worstY;
    }
}

TEST_P(Corpus, ScannerAgrees) {
    Gl gl;
    const Measurement measured(GetParam().name);
    for (const int size : {1024, 64}) {
        const compare::Difference d = measured.scanToGl(gl, size);
        EXPECT_LE(d.max, assetMax) << size << " px, at " << d.worstX << ", " << d.worstY;
    }
}

TEST_P(Corpus, ReferenceAgrees) {
    Gl gl;
    const Measurement measured(GetParam().name);
    const compare::Difference d = measured.glToReference(gl, 1024);
    const bool tips = hasGradientTips(GetParam().name);
    EXPECT_LE(d.max, tips ? gradientTipMax : referenceMax) << "at " << d.worstX << ", " << d.worstY;
    EXPECT_EQ(d.max > referenceMax, tips) << "no known fault any more";
    EXPECT_LE(d.rms, referenceRms);
}

TEST(CorpusIcons, AreDrawnAlike) {
    const fs::path icons = sharedDirectory() / "corpus/icons";
    if (!fs::exists(icons))
        GTEST_SKIP() << icons << " is absent";
    Gl gl;
    for (const fs::directory_entry& entry : fs::directory_iterator(icons)) {
        const Measurement measured("icons/" + entry.path().stem().string());
        EXPECT_LE(measured.glToAsset(gl, 64).max, assetMax) << entry.path();
        const compare::Difference d = measured.glToReference(gl, 64);
        EXPECT_LE(d.max, referenceMax) << entry.path() << " at " << d.worstX << ", " << d.worstY;
        EXPECT_LE(d.rms, referenceRms) << entry.path();
    }
}

}  // namespace
}  // namespace vtm::cases

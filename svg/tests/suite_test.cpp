// Real files: every one gives a valid scene.

#include <algorithm>

#include <vtm/image/codec.hpp>
#include "svg/tests/support.hpp"

namespace vtm::svg {
namespace {

std::vector<std::filesystem::path> svgFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".svg")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Document loadFile(const std::filesystem::path& path) {
    Options options;
    options.fileName = path.string();
    options.resourceDirectory = path.parent_path().string();
    return load(image::readFile(path.string()), options);
}

TEST(Corpus, EveryFileGivesAValidScene) {
    const auto folder = sharedFolder() / "corpus";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "corpus is absent";
    for (const auto& file : svgFiles(folder)) {
        const Document loaded = loadFile(file);
        EXPECT_NO_THROW(scene::validate(loaded.scene)) << file;
        EXPECT_FALSE(itemsOf(loaded).empty()) << file;
        EXPECT_TRUE(loaded.warnings.empty()) << file << ": " << loaded.warnings.front().message;
    }
}

TEST(Corpus, TigerHasItsPaths) {
    const auto file = sharedFolder() / "corpus" / "tiger.svg";
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << "corpus is absent";
    EXPECT_EQ(itemsOf(loadFile(file)).size(), 182u);
}

TEST(SvgSuite, EveryTestGivesAValidScene) {
    const auto folder = sharedFolder() / "svg-suite" / "tests";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "svg-suite is absent";
    for (const auto& file : svgFiles(folder)) {
        const Document loaded = loadFile(file);
        EXPECT_NO_THROW(scene::validate(loaded.scene)) << file;
        for (const Warning& warning : loaded.warnings)
            EXPECT_EQ(warning.message.find("the rest is left out"), std::string::npos) << file;
    }
}

}  // namespace
}  // namespace vtm::svg

// Folders of fonts that the tests use.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "text/font_set.hpp"

namespace vtm::text {

/// Debian's fonts-dejavu-core.
inline const std::filesystem::path dejavu = "/usr/share/fonts/truetype/dejavu";

inline std::filesystem::path suiteFonts() {
    const char* shared = std::getenv("VTM_SHARED");
    return std::filesystem::path(shared ? shared : VTM_SOURCE_DIR "/../shared") / "svg-suite" / "fonts";
}

/// Fonts of the folder only, families as the SVG suite has them.
inline FontOptions optionsOf(const std::filesystem::path& folder) {
    FontOptions options;
    options.directories = {folder.string()};
    options.systemFonts = false;
    options.serifFamily = "Noto Serif";
    options.sansSerifFamily = "Noto Sans";
    options.cursiveFamily = "Yellowtail";
    options.fantasyFamily = "Sedgwick Ave Display";
    options.monospaceFamily = "Noto Mono";
    return options;
}

inline FontQuery family(const std::string& name, double weight = 400) {
    FontQuery query;
    query.families = {name};
    query.weight = weight;
    return query;
}

/// A test of the suite's fonts, skipped where they are absent.
class SuiteFonts : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(suiteFonts()))
            GTEST_SKIP() << suiteFonts() << " of the svg-suite is absent";
    }
};

}  // namespace vtm::text

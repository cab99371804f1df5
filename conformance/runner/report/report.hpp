/// \file
/// What is written about a run, for programs (JSON, JUnit) and for people (a page).
#pragma once

#include <filesystem>
#include <vector>

#include "conformance/runner/run.hpp"

namespace vtm::conformance {

/// {"summary": {"passed", "failed", "skipped", "expected_failures"}, "cases": [a row a case]}. Throws what
/// image::writeFile throws; so do the others.
void writeJson(const std::filesystem::path& file, const std::vector<Row>& rows);
/// A testsuite a suite; expected failures count as skipped, with their reason.
void writeJunit(const std::filesystem::path& file, const std::vector<Row>& rows);

/// A folder of one index.html and PNGs.
class Report {
public:
    /// Makes the folder.
    explicit Report(std::filesystem::path folder);
    /// Writes a row's pictures and lets go of them. One at a time.
    void addPictures(Row& row) const;
    void writePage(const std::vector<Row>& rows) const;

private:
    std::filesystem::path folder_;
};

}  // namespace vtm::conformance

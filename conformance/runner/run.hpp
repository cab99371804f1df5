/// \file
/// Running cases, and what became of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/runner/suite/case.hpp"
#include "conformance/runner/suite/expectations.hpp"

namespace vtm::conformance {

enum class Verdict { Passed, Failed, Skipped, ExpectedFailure };
std::string_view nameOf(Verdict verdict);

struct Row {
    std::string name, suite, file, about;
    Verdict verdict = Verdict::Passed;
    std::string message;  ///< why it failed or was skipped; an expected failure: the reason, then why
    Outcome outcome;
    double seconds = 0;
    std::vector<std::string> pictures;  ///< files of the report: expected, drawn, difference, heat map
};

struct RunOptions {
    Setting setting;
    unsigned jobs = 1;
    std::vector<Expectation> expectations;
    /// Called once a row, on the thread that made it, one at a time; may take the pictures away.
    std::function<void(Row&)> done = {};
};

/// In the order of the cases. What a case throws is its failure.
std::vector<Row> run(const std::vector<Case>& cases, const RunOptions& options);

struct Summary {
    std::size_t passed = 0, failed = 0, skipped = 0, expectedFailures = 0;
};
Summary summarize(const std::vector<Row>& rows);

/// Names that must pass and did not, each with why. Patterns that match no row are among them, if `all` cases
/// were run.
std::vector<std::string> missedMustPass(const std::vector<Row>& rows,
                                        const std::vector<std::string>& patterns, bool all);

}  // namespace vtm::conformance

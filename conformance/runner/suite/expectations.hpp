/// \file
/// What is known to fail, with a reason, and what must pass.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vtm::conformance {

/// Whether a name matches a pattern: `*` any characters (dots too), `?` one, `[...]` one of them; without any
/// of these the name itself, and all names below it.
bool matches(const std::string& name, const std::string& pattern);

struct Expectation {
    std::string name;    ///< of one case
    std::string reason;  ///< why it fails
};

/// Lines "NAME<tab>REASON"; # begins a comment. SuiteError for a line without a reason.
std::vector<Expectation> readExpectations(const std::filesystem::path& file);
/// The reason for which a case is expected to fail.
std::optional<std::string> reasonFor(const std::string& name, const std::vector<Expectation>& expectations);

/// Patterns, one a line; # begins a comment.
std::vector<std::string> readPatterns(const std::filesystem::path& file);

}  // namespace vtm::conformance

#include "conformance/runner/suite/expectations.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <fstream>

#include <fmt/core.h>

#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {
namespace {

/// Lines that are neither empty nor comments, with their numbers.
std::vector<std::pair<int, std::string>> lines(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream)
        throw SuiteError(file.string() + ": cannot be read");
    std::vector<std::pair<int, std::string>> result;
    int number = 0;
    for (std::string line; std::getline(stream, line);)
        if (++number; !line.empty() && line[0] != '#')
            result.emplace_back(number, line);
    return result;
}

}  // namespace

bool matches(const std::string& name, const std::string& pattern) {
    if (pattern.find_first_of("*?[") != std::string::npos)
        return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    return name == pattern || name.starts_with(pattern + ".");
}

std::vector<Expectation> readExpectations(const std::filesystem::path& file) {
    std::vector<Expectation> expectations;
    for (const auto& [number, line] : lines(file)) {
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos || tab + 1 == line.size())
            throw SuiteError(
                fmt::format("{}:{}: a name, a tab and a reason are wanted", file.string(), number));
        expectations.push_back({line.substr(0, tab), line.substr(tab + 1)});
    }
    return expectations;
}

std::optional<std::string> reasonFor(const std::string& name, const std::vector<Expectation>& expectations) {
    const auto found = std::ranges::find(expectations, name, &Expectation::name);
    return found == expectations.end() ? std::nullopt : std::optional(found->reason);
}

std::vector<std::string> readPatterns(const std::filesystem::path& file) {
    std::vector<std::string> patterns;
    for (const auto& [number, line] : lines(file))
        patterns.push_back(line);
    return patterns;
}

}  // namespace vtm::conformance

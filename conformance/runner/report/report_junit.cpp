#include <algorithm>

#include <fmt/core.h>

#include "conformance/runner/report/report.hpp"
#include "conformance/runner/report/row_json.hpp"

namespace vtm::conformance {
namespace {

/// Characters that XML 1.0 has no way to write become question marks.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '"')
            result += "&quot;";
        else if (c == '\n')
            result += "&#10;";
        else
            result += std::uint8_t(c) < 0x20 ? '?' : c;
    return result;
}

std::string testcase(const Row& row) {
    const char* const element = row.verdict == Verdict::Failed ? "failure" : "skipped";
    std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
                                   escaped(row.suite), escaped(row.name), row.seconds);
    if (row.verdict == Verdict::Passed)
        return text + "/>\n";
    return text + fmt::format("><{} message=\"{}: {}\"/></testcase>\n", element, nameOf(row.verdict),
                              escaped(row.message));
}

std::string testsuite(const std::string& suite, const std::vector<Row>& rows) {
    const Summary s = summarize(rows);
    double seconds = 0;
    std::string cases;
    for (const Row& row : rows) {
        seconds += row.seconds;
        cases += testcase(row);
    }
    return fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n{}"
        "  </testsuite>\n",
        escaped(suite), rows.size(), s.failed, s.skipped + s.expectedFailures, seconds, cases);
}

}  // namespace

void writeJunit(const std::filesystem::path& file, const std::vector<Row>& rows) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (auto first = rows.begin(); first != rows.end();) {
        const auto last =
            std::find_if(first, rows.end(), [&](const Row& row) { return row.suite != first->suite; });
        text += testsuite(first->suite, {first, last});
        first = last;
    }
    writeText(file, text + "</testsuites>\n");
}

}  // namespace vtm::conformance

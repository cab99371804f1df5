// vtm-conformance: runs the suites of conformance/suites. docs/testing.md says what they hold.

#include <algorithm>
#include <exception>
#include <thread>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "conformance/runner/kinds/survey.hpp"
#include "conformance/runner/report/report.hpp"
#include "conformance/runner/suite/suite.hpp"

namespace {

using namespace vtm::conformance;
namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> patterns, excluded, engines, faults;
    fs::path suites = fs::path(VTM_SOURCE_DIR) / "conformance/suites";
    fs::path json, junit, report;
    unsigned jobs = std::max(1u, std::thread::hardware_concurrency()), every = 1;
    bool list = false, quiet = false, expectations = false, full = false, failed = false, asItIs = false;
};

void addOptions(CLI::App& app, Arguments& a) {
    app.add_option("PATTERN", a.patterns, "Cases: a name, all below it, or a glob; without, all");
    app.add_option("--exclude", a.excluded, "Leave these out")->expected(1, -1)->delimiter(',');
    app.add_option("--engine", a.engines, "Only these: gl, asset, scan, reference")->delimiter(',');
    app.add_option("--every", a.every, "Only every k-th case")->check(CLI::PositiveNumber);
    app.add_option("--jobs,-j", a.jobs, "Cases at once")->check(CLI::PositiveNumber);
    app.add_option("--json", a.json, "Write a summary and a row a case");
    app.add_option("--junit", a.junit, "Write JUnit XML");
    app.add_option("--report", a.report, "Write a page with the pictures of every case into this folder");
    app.add_flag("--failed", a.failed, "... with those of failed cases only");
    app.add_flag("--full", a.full, "All cases of the suites that have more than run every day");
    app.add_flag("--no-shrink", a.asItIs, "Do not look for the smallest scene that fails");
    app.add_flag("--list", a.list, "Print names and run nothing");
    app.add_flag("--quiet,-q", a.quiet, "Print failures, what was skipped and the summary only");
    app.add_flag("--expectations", a.expectations,
                 "Print what the lists of expected failures should hold now");
    app.add_option("--inject", a.faults,
                   "Make this mistake on purpose in every case (or: every), and say which "
                   "suites see it");
    app.add_option("--suites", a.suites, "The folder of suites")->check(CLI::ExistingDirectory);
}

bool any(const std::string& name, const std::vector<std::string>& patterns) {
    return std::ranges::any_of(patterns, [&](const std::string& p) { return matches(name, p); });
}

std::vector<Case> selected(const Arguments& a) {
    std::vector<Case> all = loadSuites(a.suites, a.full ? Extent::Full : Extent::Daily), chosen;
    std::size_t count = 0;
    for (Case& one : all)
        if ((a.patterns.empty() || any(one.name, a.patterns)) && !any(one.name, a.excluded) &&
            count++ % a.every == 0)
            chosen.push_back(std::move(one));
    return chosen;
}

/// `file` of every suite.
template <class Read>
auto gathered(const fs::path& suites, const char* file, Read read) {
    decltype(read(suites)) all;
    for (const fs::directory_entry& suite : fs::directory_iterator(suites))
        if (fs::exists(suite.path() / file)) {
            auto more = read(suite.path() / file);
            all.insert(all.end(), more.begin(), more.end());
        }
    return all;
}

Setting settingOf(const Arguments& a) {
    Setting setting;
    if (!a.engines.empty()) {
        setting.engines.clear();
        for (const std::string& name : a.engines)
            setting.engines.push_back(engineOf(name));
    }
    setting.shrink = !a.asItIs;
    setting.keepPictures = !a.failed && !a.report.empty();
    return setting;
}

void print(const Row& row, bool quiet) {
    if (!quiet || row.verdict == Verdict::Failed || row.verdict == Verdict::Skipped)
        fmt::print("{:<16} {}{}{}\n", nameOf(row.verdict), row.name, row.message.empty() ? "" : ": ",
                   row.message);
}

/// As CTest is told.
constexpr int allSkipped = 77;

/// The exit code.
int runAll(const std::vector<Case>& cases, const Arguments& a) {
    const std::optional<Report> report = a.report.empty() ? std::nullopt : std::optional<Report>(a.report);
    RunOptions options{settingOf(a), a.jobs, gathered(a.suites, "expectations.tsv", readExpectations), {}};
    options.done = [&](Row& row) {
        print(row, a.quiet);
        if (report)
            report->addPictures(row);
        row.outcome.pictures.reset();
    };
    const std::vector<Row> rows = run(cases, options);
    if (!a.json.empty())
        writeJson(a.json, rows);
    if (!a.junit.empty())
        writeJunit(a.junit, rows);
    if (report)
        report->writePage(rows);
    if (a.expectations)
        for (const Row& row : rows)
            if (row.outcome.status == Outcome::Status::Failed)
                fmt::print("{}\t{}\n", row.name,
                           reasonFor(row.name, options.expectations).value_or(row.message));
    const bool whole = a.patterns.empty() && a.excluded.empty() && a.every == 1 && a.engines.empty();
    const auto missed = missedMustPass(rows, gathered(a.suites, "must_pass.txt", readPatterns), whole);
    for (const std::string& name : missed)
        fmt::print("must pass        {}\n", name);
    const Summary s = summarize(rows);
    fmt::print("{} passed, {} failed, {} skipped, {} expected failures\n", s.passed, s.failed, s.skipped,
               s.expectedFailures);
    if (s.skipped == rows.size())
        return allSkipped;
    return s.failed == 0 && missed.empty() ? 0 : 1;
}

/// Cases that fail without an injected fault see none.
std::vector<Case> withoutKnownFailures(std::vector<Case> cases, const Arguments& a) {
    const auto known = gathered(a.suites, "expectations.tsv", readExpectations);
    std::erase_if(cases, [&](const Case& one) { return reasonFor(one.name, known).has_value(); });
    return cases;
}

int runSuites(const Arguments& a) {
    const std::vector<Case> cases = selected(a);
    if (cases.empty())
        throw SuiteError("no case matches");
    if (a.list) {
        for (const Case& one : cases)
            fmt::print("{}\n", one.name);
        return 0;
    }
    if (!a.faults.empty())
        return surveyFaults(withoutKnownFailures(cases, a), a.faults, settingOf(a), a.jobs) ? 0 : 1;
    return runAll(cases, a);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Runs the conformance suites. Exit code 0: all is as expected; 1: it is not; 2: bad usage; 77: all "
        "was skipped.",
        "vtm-conformance"};
    Arguments arguments;
    addOptions(app, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        return runSuites(arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "vtm-conformance: {}\n", error.what());
        return 2;
    }
}

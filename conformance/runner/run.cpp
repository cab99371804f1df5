#include "conformance/runner/run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

namespace vtm::conformance {
namespace {

Outcome outcomeOf(const Case& one, const Setting& setting) {
    try {
        return one.run(setting);
    } catch (const std::exception& error) {
        return Outcome::failed(std::string("threw: ") + error.what());
    }
}

/// An expected failure that passes is a failure: the list would be out of date.
void decide(Row& row, const std::vector<Expectation>& expectations) {
    const std::optional<std::string> reason = reasonFor(row.name, expectations);
    row.message = row.outcome.message;
    if (row.outcome.status == Outcome::Status::Skipped) {
        row.verdict = Verdict::Skipped;
    } else if (row.outcome.status == Outcome::Status::Failed) {
        row.verdict = reason ? Verdict::ExpectedFailure : Verdict::Failed;
        if (reason)
            row.message = *reason + " | " + row.message;
    } else if (reason) {
        row.verdict = Verdict::Failed;
        row.message = "passes, but is expected to fail: " + *reason;
    }
}

Row rowOf(const Case& one, const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    Row row;
    row.name = one.name, row.suite = one.name.substr(0, one.name.find('.'));
    row.file = one.file, row.about = one.about;
    row.outcome = outcomeOf(one, options.setting);
    decide(row, options.expectations);
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return row;
}

}  // namespace

std::string_view nameOf(Verdict verdict) {
    constexpr std::string_view names[] = {"passed", "failed", "skipped", "expected failure"};
    return names[std::size_t(verdict)];
}

std::vector<Row> run(const std::vector<Case>& cases, const RunOptions& options) {
    std::vector<Row> rows(cases.size());
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    const auto work = [&] {
        for (std::size_t i = next++; i < cases.size(); i = next++) {
            rows[i] = rowOf(cases[i], options);
            if (options.done) {
                const std::lock_guard lock(mutex);
                options.done(rows[i]);
            }
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned job = 0; job < options.jobs; ++job)
        threads.emplace_back(work);
    threads.clear();  // joins them
    return rows;
}

Summary summarize(const std::vector<Row>& rows) {
    const auto count = [&](Verdict verdict) {
        return std::size_t(std::ranges::count(rows, verdict, &Row::verdict));
    };
    return {count(Verdict::Passed), count(Verdict::Failed), count(Verdict::Skipped),
            count(Verdict::ExpectedFailure)};
}

std::vector<std::string> missedMustPass(const std::vector<Row>& rows,
                                        const std::vector<std::string>& patterns, bool all) {
    std::vector<std::string> missed;
    for (const std::string& pattern : patterns) {
        bool found = false;
        for (const Row& row : rows)
            if (matches(row.name, pattern)) {
                found = true;
                if (row.verdict != Verdict::Passed)
                    missed.push_back(row.name + ": " + std::string(nameOf(row.verdict)));
            }
        if (!found && all)
            missed.push_back(pattern + ": there is no such case");
    }
    return missed;
}

}  // namespace vtm::conformance

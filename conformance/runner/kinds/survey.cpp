#include "conformance/runner/kinds/survey.hpp"

#include <map>

#include <fmt/core.h>

#include "conformance/runner/run.hpp"

namespace vtm::conformance {
namespace {

struct Count {
    std::size_t seen = 0, all = 0;
};

std::map<std::string, Count> countsOf(const std::vector<Row>& rows) {
    std::map<std::string, Count> counts;
    for (const Row& row : rows)
        if (row.verdict != Verdict::Skipped) {
            ++counts[row.suite].all;
            counts[row.suite].seen += row.verdict == Verdict::Failed;
        }
    return counts;
}

std::vector<Fault> faultsOf(const std::vector<std::string>& names) {
    if (names == std::vector<std::string>{"every"})
        return allFaults();
    std::vector<Fault> faults;
    for (const std::string& name : names)
        faults.push_back(faultOf(name));
    return faults;
}

}  // namespace

bool surveyFaults(const std::vector<Case>& cases, const std::vector<std::string>& names, Setting setting,
                  unsigned jobs) {
    bool all = true;
    fmt::print("| fault | seen by |\n|---|---|\n");
    for (const Fault fault : faultsOf(names)) {
        setting.fault = fault;
        bool seen = false;
        std::string suites;
        for (const auto& [suite, count] : countsOf(run(cases, {setting, jobs, {}, {}}))) {
            if (count.seen > 0)
                suites +=
                    fmt::format("{}{} {} of {}", suites.empty() ? "" : ", ", suite, count.seen, count.all);
            seen = seen || count.seen > 0;
        }
        fmt::print("| {} | {} |\n", nameOf(fault), seen ? suites : "nobody");
        all = all && seen;
    }
    return all;
}

}  // namespace vtm::conformance

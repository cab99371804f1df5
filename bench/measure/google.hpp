/// \file
/// Google Benchmark, whose results become rows of a report.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace vtm::bench {

/// What the repetitions of one registered benchmark came to.
struct Measured {
    std::string name;
    std::string label;                                    ///< State::SetLabel
    std::vector<double> milliseconds;                     ///< of an iteration, a repetition each
    std::map<std::string, std::vector<double>> counters;  ///< a repetition each
};

struct Effort {
    int repetitions;
    double seconds;  ///< of each, at least
};

/// Runs what is registered and matches the regular expression, and forgets all that is registered.
std::vector<Measured> runRegistered(const std::string& filter, Effort effort);

}  // namespace vtm::bench

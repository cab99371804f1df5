/// \file
/// Which pictures `render` draws, and where they go.
#pragma once

#include <string>
#include <vector>

namespace vtm::tools {

struct Job {
    std::string input, output;
};

/// Lines IN<TAB>OUT of a file, or of standard input for "-"; empty ones do not count. Throws
/// std::runtime_error.
std::vector<Job> readBatch(const std::string& path);

/// Into one file, or into a directory: one that exists, that ends in '/', or that many inputs go to; pictures
/// in it are called as their inputs, with `suffix`. Throws UsageError.
std::vector<Job> jobsOf(const std::vector<std::string>& inputs, const std::string& output,
                        const std::string& suffix);

/// Throws UsageError where a job would overwrite what another one writes or any reads.
/// `batch`: the list that they came from, if any.
void refuseLoss(const std::vector<Job>& jobs, const std::string& batch);

}  // namespace vtm::tools

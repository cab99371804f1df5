#include "tools/commands/jobs.hpp"

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/input/input.hpp"
#include "tools/output/output.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

namespace {

namespace fs = std::filesystem;

bool meansDirectory(const std::string& output) { return output.ends_with('/') || fs::is_directory(output); }

/// The picture's file in a directory.
std::string fileFor(const std::string& input, const std::string& directory, const std::string& suffix) {
    const std::string stem = input == standardStream ? "stdin" : fs::path(input).stem().string();
    return (fs::path(directory) / stem).string() + suffix;
}

}  // namespace

std::vector<Job> readBatch(const std::string& path) {
    const Input list = readInput(path);
    std::istringstream text(std::string(list.bytes.begin(), list.bytes.end()));
    std::vector<Job> jobs;
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
        if (line.empty())
            continue;
        const std::size_t tab = line.find('\t');
        if (tab == std::string::npos || tab == 0 || tab + 1 == line.size())
            throw std::runtime_error(fmt::format("{}:{}:1: expected IN<TAB>OUT", list.name, number));
        jobs.push_back({line.substr(0, tab), line.substr(tab + 1)});
    }
    return jobs;
}

std::vector<Job> jobsOf(const std::vector<std::string>& inputs, const std::string& output,
                        const std::string& suffix) {
    if (inputs.empty() || output.empty())
        throw UsageError("render: needs IN... and -o OUT, or --batch LIST");
    const bool directory = meansDirectory(output);
    if (!directory && inputs.size() == 1)
        return {{inputs[0], output}};
    if (!directory && (fs::path(output).has_extension() || isStandardOutput(output)))
        throw UsageError("-o: several inputs need a directory, not " + output);
    std::vector<Job> jobs;
    for (const std::string& input : inputs)
        jobs.push_back({input, fileFor(input, output, suffix)});
    return jobs;
}

void refuseLoss(const std::vector<Job>& jobs, const std::string& batch) {
    std::vector<std::string> inputs, outputs;
    if (!batch.empty())
        inputs.push_back(batch);
    for (const Job& job : jobs) {
        inputs.push_back(job.input);
        outputs.push_back(job.output);
    }
    refuseLoss(inputs, outputs);
}

}  // namespace vtm::tools

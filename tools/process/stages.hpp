/// \file
/// How long each stage of the work took.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace vtm::tools {

/// Milliseconds by stage, in the order in which the stages ran.
using Stages = std::vector<std::pair<std::string, double>>;

template <class Work>
double millisecondsOf(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Runs `work`, records how long it took under `stage`, returns its result.
template <class Work>
auto timed(Stages& stages, const std::string& stage, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    stages.emplace_back(stage, took.count());
    return result;
}

}  // namespace vtm::tools

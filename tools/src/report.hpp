/// \file
/// What the command says: figures as text or JSON, warnings, errors.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/compiler/compile.hpp>
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"

namespace vtm::tools {

/// Keys keep the order in which they were given.
using Json = nlohmann::ordered_json;

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

Json toJson(const Stages& stages);

/// The figures that `compile`, `info` and `render` share.
Json figures(const asset::Asset& asset);
/// How far boundaries may be off, and where that could not be proven.
Json figures(const compiler::Result& result);
/// Those of paper mode.
Json figures(const paper::CompileResult& paper);
/// What a pixel's lookup touched, on the mean.
Json perPixel(const paper::Cost& cost, std::uint64_t pixels);

/// As JSON with a line end: on one line, or indented. What is no UTF-8, in names of files, is replaced.
std::string jsonLine(const Json& object);
std::string jsonText(const Json& object);

/// A whole number with a comma every three digits.
std::string readable(double number);

/// One `key: value` a line; nested objects indented.
std::string toText(const Json& object, int indent = 0);

/// A line on standard error, over a progress bar if there is one. If it cannot be written, nobody can be
/// told.
void say(const std::string& message);

/// The same of what is no error: nothing after beQuiet().
void warn(const std::string& message);
void beQuiet();
bool isQuiet();

/// `path: what`, for the exception being handled; `what` alone where it names the path itself. A
/// StandardOutputError is thrown on.
std::string describeError(const std::string& path);

}  // namespace vtm::tools

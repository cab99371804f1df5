/// \file
/// The subcommands of `vtm`. Each adds itself to the application and runs when it was chosen.
#pragma once

#include <stdexcept>

#include <CLI/CLI.hpp>

namespace vtm::tools {

/// Exit codes.
inline constexpr int done = 0, badInput = 1, badUsage = 2;

/// What was typed contradicts itself or asks for something that does not exist.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// `exitCode` is set when the subcommand has run; it must outlive the parsing.
void addRender(CLI::App& app, int& exitCode);
void addCompile(CLI::App& app, int& exitCode);
void addInfo(CLI::App& app, int& exitCode);
void addDiff(CLI::App& app, int& exitCode);
void addTrace(CLI::App& app, int& exitCode);

}  // namespace vtm::tools

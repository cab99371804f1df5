/// \file
/// The subcommands of `vtm`. Each adds itself to the application and runs when it was chosen.
#pragma once

#include <csignal>
#include <stdexcept>

#include <CLI/CLI.hpp>

namespace vtm::tools {

/// Exit codes. The last one is what a shell shows of a program that SIGPIPE ended.
inline constexpr int done = 0, badInput = 1, badUsage = 2, closedPipe = 128 + SIGPIPE;

/// For --help.
inline constexpr const char* exitCodes =
    "Examples:\n"
    "  vtm render tiger.svg -o tiger.png -w 800\n"
    "  vtm compile tiger.svg -o tiger.vtm\n"
    "  vtm diff a.png b.png --max 2\n"
    "  vtm render --help\n\n"
    "Exit codes: 0 done; 1 bad input, or something could not be read, drawn or written; 2 bad usage; 141 "
    "nobody reads "
    "standard output any more.\n"
    "A file is written whole or not at all. - is standard input or standard output; messages go to standard "
    "error.";

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

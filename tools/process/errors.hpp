/// \file
/// Exit codes, and the exception for bad usage.
#pragma once

#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

namespace vtm::tools {

/// Exit codes. The last one is what a shell shows of a program that SIGPIPE ended.
inline constexpr int done = 0, badInput = 1, badUsage = 2, closedPipe = 128 + SIGPIPE;

/// The arguments contradict each other or ask for something that does not exist.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Standard output cannot be written. It ends the command: nothing more can be reported.
class StandardOutputError : public std::runtime_error {
public:
    explicit StandardOutputError(int error)
        : std::runtime_error("standard output: cannot be written: " + std::generic_category().message(error)),
          brokenPipe_(error == EPIPE) {}
    /// The reader closed the pipe: no fault, and nothing to say.
    bool isBrokenPipe() const { return brokenPipe_; }

private:
    bool brokenPipe_;
};

}  // namespace vtm::tools

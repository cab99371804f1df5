/// \file
/// Standard output: what the command was asked for. Everything else it says goes to standard error.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

namespace vtm::tools {

/// Standard output does not take what was written. It ends the command: nothing more can be told.
class StandardOutputError : public std::runtime_error {
public:
    explicit StandardOutputError(int error);
    /// Nobody reads the pipe any more: no fault, and nothing to say.
    bool isBrokenPipe() const { return brokenPipe_; }

private:
    bool brokenPipe_;
};

/// At once, without a buffer. Throw StandardOutputError.
void print(std::string_view text);
void print(std::span<const std::uint8_t> bytes);

bool standardOutputIsTerminal();

}  // namespace vtm::tools

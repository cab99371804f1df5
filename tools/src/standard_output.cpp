#include "tools/src/standard_output.hpp"

#include <cerrno>
#include <system_error>

#include <unistd.h>

#include <vtm/image/codec.hpp>

namespace vtm::tools {

StandardOutputError::StandardOutputError(int error)
    : std::runtime_error("standard output: cannot be written: " + std::generic_category().message(error)),
      brokenPipe_(error == EPIPE) {}

void print(std::string_view text) {
    print(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void print(std::span<const std::uint8_t> bytes) {
    if (const int error = image::writeStream(STDOUT_FILENO, bytes); error != 0)
        throw StandardOutputError(error);
}

bool standardOutputIsTerminal() { return isatty(STDOUT_FILENO) == 1; }

}  // namespace vtm::tools

#include "tools/src/progress.hpp"

#include <cstdio>
#include <string>

#include <fmt/core.h>
#include <unistd.h>

namespace vtm::tools {

namespace {

constexpr std::size_t barWidth = 40;

bool onTerminal() {
    static const bool terminal = isatty(STDERR_FILENO) == 1;
    return terminal;
}

}  // namespace

void showProgress(std::size_t finished, std::size_t total) {
    if (!onTerminal() || total < 2)
        return;
    const std::size_t filled = barWidth * finished / total;
    const std::string bar = fmt::format("\r[{}{}] {}/{}", std::string(filled, '#'),
                                        std::string(barWidth - filled, ' '), finished, total);
    std::fputs(bar.c_str(), stderr);
}

void clearProgress() {
    if (onTerminal())
        std::fputs("\r\x1b[K", stderr);
}

}  // namespace vtm::tools

#include "tools/src/progress.hpp"

#include <cstdio>
#include <string>

#include <fmt/core.h>
#include <unistd.h>

#include "tools/src/report.hpp"

namespace vtm::tools {

namespace {

constexpr std::size_t barWidth = 40;

bool onTerminal() {
    static const bool terminal = isatty(STDERR_FILENO) == 1;
    return terminal && !isQuiet();
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

void showWork(const limits::Progress& progress) {
    constexpr double soon = 1;  // seconds that nobody waits for
    if (!onTerminal() || progress.seconds < soon)
        return;
    const std::string share = progress.done > 0 ? fmt::format(" {:.0f} %", 100 * progress.done) : "";
    std::fputs(fmt::format("\r\x1b[K{:.0f} s: {}{}", progress.seconds, progress.stage, share).c_str(),
               stderr);
}

void clearProgress() {
    if (onTerminal())
        std::fputs("\r\x1b[K", stderr);
}

}  // namespace vtm::tools

#include "tools/process/messages.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <new>

#include <fmt/core.h>
#include <unistd.h>

#include "tools/process/errors.hpp"
#include "tools/process/limits.hpp"

namespace vtm::tools {

namespace {

bool quiet = false;  ///< --quiet

constexpr std::size_t barWidth = 40;

bool onTerminal() {
    static const bool terminal = isatty(STDERR_FILENO) == 1;
    return terminal && !quiet;
}

std::string withPath(const std::string& path, const std::string& what) {
    return what.find(path) != std::string::npos ? what : path + ": " + what;
}

}  // namespace

void say(const std::string& message) {
    clearProgress();
    std::fputs((message + "\n").c_str(), stderr);
}

void warn(const std::string& message) {
    if (!quiet)
        say(message);
}

void beQuiet() { quiet = true; }

std::string describeError(const std::string& path) {
    try {
        throw;
    } catch (const StandardOutputError&) {
        throw;
    } catch (const limits::Exceeded& exceeded) {
        return describe(path, exceeded);
    } catch (const std::bad_alloc&) {
        return path + ": not enough memory";
    } catch (const std::exception& error) {
        return withPath(path, error.what());
    }
}

std::string readable(double number) {
    constexpr double max = 1e15;  // beyond it nobody counts digits, nor are all of them exact
    if (!(std::abs(number) < max))
        return fmt::format("{:.2g}", number);
    std::string digits = fmt::format("{:.0f}", number);
    const std::size_t first = digits.starts_with('-') ? 1 : 0;
    for (std::size_t at = digits.size(); at > first + 3;)
        digits.insert(at -= 3, 1, ',');
    return digits;
}

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

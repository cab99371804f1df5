#include "tools/process/limits.hpp"

#include <cstdio>

#include <unistd.h>

#include <fmt/core.h>

#include <vtm/image/codec.hpp>
#include "tools/process/errors.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {
namespace {

struct Allowance {
    double seconds = 60;
    double megabytes = 4096;
};
Allowance allowance;

std::string optionOf(const limits::Exceeded& exceeded) {
    if (exceeded.limit() == limits::Limit::Seconds)
        return fmt::format("--max-seconds {:g}", allowance.seconds);
    return fmt::format("--max-memory {:g}", allowance.megabytes);
}

/// Ends the process at once: nothing is freed, no other thread is waited for.
[[noreturn]] void giveUp(const std::string& message) {
    const std::string line = message + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);  // unbuffered
    image::removeTemporaries();
    _exit(badInput);
}

limits::Limits limitsOf(const std::string& path, bool alone) {
    limits::Limits result;
    result.seconds = allowance.seconds;
    result.memoryBytes = static_cast<std::size_t>(allowance.megabytes * (1 << 20));
    if (alone)
        result.proceed = [](const limits::Progress& progress) {
            showWork(progress);
            return true;
        };
    result.overrunHandler = [path, alone](const limits::Exceeded& exceeded, bool isEnding) {
        if (alone || !isEnding)
            giveUp(describe(path, exceeded));
    };
    return result;
}

}  // namespace

void setMaxSeconds(double seconds) { allowance.seconds = seconds; }

void setMaxMegabytes(double megabytes) { allowance.megabytes = megabytes; }

PictureLimits::PictureLimits(std::string path, bool alone)
    : budget_(limitsOf(path, alone)), scope_(budget_), alone_(alone) {}

PictureLimits::~PictureLimits() {
    clearProgress();
    if (!alone_)
        trimHeap();
}

double secondsForFirstTry() {
    const limits::Budget* budget = limits::current().budget;
    return budget && allowance.seconds > 0 ? allowance.seconds / 3 - budget->seconds() : 0;
}

std::string describe(const std::string& path, const limits::Exceeded& exceeded) {
    const limits::Place& place = exceeded.place();
    const std::string where = place.line > 0 ? fmt::format("{}:{}:{}", path, place.line, place.column) : path;
    if (exceeded.limit() == limits::Limit::Cancelled)
        return fmt::format("{}: cancelled{}", where, exceeded.during());
    return fmt::format("{}: {}: exceeded{}", where, optionOf(exceeded), exceeded.during());
}

}  // namespace vtm::tools

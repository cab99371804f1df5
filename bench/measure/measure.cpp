#include "bench/measure/measure.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

namespace vtm::bench {
namespace {

double milliseconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

clockid_t spent = CLOCK_PROCESS_CPUTIME_ID;

}  // namespace

/// Of /proc, since getrusage keeps the peak of the program that ran in the process before.
double peakBytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:"))
            return std::stod(line.substr(6)) * 1024;  // Linux counts kibibytes
    return 0;
}

double threadMilliseconds() { return milliseconds(CLOCK_THREAD_CPUTIME_ID); }
double wallMilliseconds() { return milliseconds(CLOCK_MONOTONIC); }
double spentMilliseconds() { return milliseconds(spent); }
void measureWallTime() { spent = CLOCK_MONOTONIC; }
const char* clockName() { return spent == CLOCK_MONOTONIC ? "Wall" : "CPU"; }

void useSteadyConditions() {
    if (const int here = sched_getcpu(); here >= 0) {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(here, &one);
        sched_setaffinity(0, sizeof one, &one);
    }
    constexpr int mmapThreshold = 32 << 20;  // bytes; the most that glibc takes
    constexpr int trimThreshold = 1 << 30;   // bytes; no process frees so many at its end
    mallopt(M_MMAP_THRESHOLD, mmapThreshold);
    mallopt(M_TRIM_THRESHOLD, trimThreshold);
    // Of those that it starts; Skia's and resvg's modules have mimalloc.
    setenv("MALLOC_MMAP_THRESHOLD_", std::to_string(mmapThreshold).c_str(), 1);
    setenv("MALLOC_TRIM_THRESHOLD_", std::to_string(trimThreshold).c_str(), 1);
    setenv("MIMALLOC_PURGE_DELAY", "-1", 1);  // of its version 2: never
    setenv("MIMALLOC_PAGE_RESET", "0", 1);    // of its version 1
}

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[std::size_t(share * double(values.size() - 1) + 0.5)];
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

Paired pairwise(const std::function<void()>& first, const std::function<void()>& second, double budget,
                int maximum) {
    first();
    second();
    std::vector<double> firsts, seconds, ratios;
    for (double spent = 0; int(ratios.size()) < 5 || (spent < budget && int(ratios.size()) < maximum);) {
        firsts.push_back(spentTime(first));
        seconds.push_back(spentTime(second));
        ratios.push_back(seconds.back() / firsts.back());
        spent += firsts.back() + seconds.back();
    }
    return {median(firsts),         median(seconds),        median(ratios),
            quantile(ratios, 0.25), quantile(ratios, 0.75), int(ratios.size())};
}

std::optional<ChildUse> inChild(const std::function<void()>& prepare, const std::function<double()>& work) {
    int ends[2];
    if (pipe(ends) != 0)
        return std::nullopt;
    const pid_t child = fork();
    if (child < 0)
        return std::nullopt;
    if (child == 0) {
        close(ends[0]);
        const double before = peakBytes();
        ChildUse use;
        try {
            prepare();
            use.preparedBytes = peakBytes() - before;
            const double cpu = milliseconds(CLOCK_PROCESS_CPUTIME_ID), wall = wallMilliseconds();
            use.result = work();
            use.cpu = milliseconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
            use.wall = wallMilliseconds() - wall;
        } catch (...) {
            _exit(1);
        }
        use.peakBytes = peakBytes() - before;
        _exit(write(ends[1], &use, sizeof use) == ssize_t(sizeof use) ? 0 : 1);
    }
    close(ends[1]);
    ChildUse use;
    const bool complete = read(ends[0], &use, sizeof use) == ssize_t(sizeof use);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return complete && status == 0 ? std::optional(use) : std::nullopt;
}

}  // namespace vtm::bench

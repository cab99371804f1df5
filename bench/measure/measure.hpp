/// \file
/// How time and memory are measured.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace vtm::bench {

/// CPU time of the calling thread in milliseconds.
double threadMilliseconds();
/// Wall time in milliseconds.
double wallMilliseconds();
/// CPU time of this process in milliseconds: all its threads, no waiting. After measureWallTime(), wall time:
/// for drivers whose work is not done on the CPU.
double spentMilliseconds();
void measureWallTime();
/// Which of both, as a word in front of "milliseconds".
const char* clockName();

/// Conditions under which CPU time is that of the work, for this process and those that it starts:
/// - One processor, the one on which it runs, where the system allows that. No thread spins until another has
///   done its part, and nothing is counted late. (The clock of a process may count what its other threads did
///   only once they sleep: the median of drawings that took 2.8 ms on two threads was then 1.5.)
/// - Allocators keep what is freed: glibc's, and mimalloc. Memory that was given back to the system comes
///   again page by page, and a page takes from 0.2 to 7 µs, by the machine.
void useSteadyConditions();

/// Bytes of the largest resident set of this process since its program began.
double peakBytes();

/// Milliseconds spent on one call.
template <class Work>
double spentTime(Work&& work) {
    const double start = spentMilliseconds();
    work();
    return spentMilliseconds() - start;
}

/// The value that `share` of the others are not above; 0 of none.
double quantile(std::vector<double> values, double share);
double median(std::vector<double> values);

/// Two things that took turns, so that both met the same machine.
struct Paired {
    double first = 0, second = 0;  ///< medians, milliseconds spent
    double ratio = 0;              ///< median of second / first, pair by pair
    double low = 0, high = 0;      ///< quartiles of that ratio
    int pairs = 0;
};

/// Pairs until `budget` (milliseconds) is spent, at least five, at most `maximum`. One pair before them
/// is not counted.
Paired pairwise(const std::function<void()>& first, const std::function<void()>& second, double budget,
                int maximum);

/// What a child process used.
struct ChildUse {
    double cpu = 0, wall = 0;  ///< milliseconds
    double peakBytes = 0;      ///< largest resident set, that of the bare process taken off
    double preparedBytes = 0;  ///< the same before `work`
    double result = 0;         ///< what `work` returned
};

/// Runs `prepare` and `work` in a child process, so that peaks do not add up; times are those of `work`
/// alone. Nothing if the child failed.
std::optional<ChildUse> inChild(const std::function<void()>& prepare, const std::function<double()>& work);

}  // namespace vtm::bench

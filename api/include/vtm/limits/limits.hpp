/// \file
/// Limits of time and memory for the library's work on a thread, a callback for progress and cancellation,
/// and the current stage of the work (docs/limits.md).
///
///     limits::Budget budget({.seconds = 4, .memoryBytes = 900 << 20});
///     const limits::Scope scope(budget);
///     svg::load(...), compiler::compile(...), ...   // throw limits::Exceeded
///
/// Without a Scope nothing is limited.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <vtm/error.hpp>

#pragma GCC visibility push(default)

namespace vtm::limits {

/// A position in a source file. Lines and columns count from 1; 0 means unknown.
struct Place {
    std::uint32_t line = 0, column = 0;
    const char* element = "";  ///< the element's name, a string with static storage duration
    std::uint32_t character =
        0;  ///< of a glyph: its first character in the `text` element, from 1; 0: no glyph
};

enum class Limit { Seconds, Memory, Cancelled };

/// A limit was exceeded, or the callback cancelled. Only the result in progress is lost.
class Exceeded : public Error {
public:
    Exceeded(Limit limit, double value, std::string stage, Place place);
    Limit limit() const { return limit_; }
    double value() const { return value_; }              ///< the limit, in seconds or bytes
    const std::string& stage() const { return stage_; }  ///< for example "stroking"; may be empty
    const Place& place() const { return place_; }
    /// Returns text such as ` while stroking <path>`; empty if the stage is unknown.
    std::string during() const;

private:
    Limit limit_;
    double value_;
    std::string stage_;
    Place place_;
};

struct Progress {
    const char* stage = "";  ///< the stage that a thread of the budget began last; may be empty
    double done = 0;         ///< share of that stage, in [0, 1]
    double seconds = 0;      ///< time used so far
    std::size_t bytes = 0;   ///< resident memory now
};

/// The limits of a budget; 0 or empty means no such limit.
struct Limits {
    /// Max of CPU time (all threads of the process) and wall time since the budget began, seconds.
    double seconds = 0;
    /// Resident memory of the whole process, including what it used before.
    std::size_t memoryBytes = 0;
    /// Called about every 20 ms on the budget's own thread; returning false cancels. Must not throw.
    std::function<bool(const Progress&)> proceed = {};
    /// A last resort: called once on the budget's own thread if the budget still lives at `overrun` times a
    /// limit. `isEnding`: Exceeded was thrown and the stack is still unwinding; otherwise the thread is
    /// inside code of another library.
    std::function<void(const Exceeded&, bool isEnding)> overrunHandler = {};

    static constexpr double overrun = 1.08;
};

/// A thread's current work: the stage, and a function that finds the place only when it is needed.
struct Work {
    const char* stage = "";
    Place (*place)(const void*) = nullptr;
    const void* of = nullptr;

    bool operator==(const Work&) const = default;
};

/// Enforces limits. A thread of its own measures every few milliseconds.
class Budget {
public:
    explicit Budget(Limits limits);
    ~Budget();
    Budget(const Budget&) = delete;
    Budget& operator=(const Budget&) = delete;

    const Limits& limits() const { return limits_; }
    /// Time used since the budget began, as Limits::seconds counts it.
    double seconds() const;
    bool isExceeded() const { return state_.load(std::memory_order_relaxed) != held; }
    /// Cancels the work; may be called from any thread.
    void cancel() { stop(Limit::Cancelled); }

    // What follows is for the library itself.
    void throwIfExceeded() const;
    void need(std::size_t bytes);
    void begin(const Work& work) const;
    void end(const Work& work, const Work& before) const;
    void progress(double done) const { done_.store(done, std::memory_order_relaxed); }

private:
    static constexpr int held = -1;
    void stop(Limit limit);
    void watch();
    void measure();
    void measureOverrun();
    Exceeded exceeded() const;
    void keep(const Work& work) const;
    double valueOf(Limit limit) const;

    const Limits limits_;
    const double startWall_, startCpu_;
    std::atomic<int> state_{held};  ///< a Limit, once one is exceeded
    mutable std::atomic<const char*> stage_{""};
    mutable std::atomic<double> done_{0};
    double lastCall_ = 0;
    bool overrun_ = false;
    mutable std::mutex thrownMutex_;
    mutable std::optional<Exceeded> thrown_;  ///< the first
    mutable std::mutex lastMutex_;
    mutable Work last_;  ///< that a thread began last and has not ended; kept for the overrunHandler only
    mutable Place lastPlace_;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool isEnding_ = false;
    std::thread watcher_;
};

/// The budget and work of a thread, to be passed on to its worker threads.
struct Context {
    Budget* budget = nullptr;
    Work work;
};
Context current();

/// Applies a budget, or the context of another thread, to this thread while the Scope lives. The innermost of
/// nested scopes applies. The budget must outlive the Scope.
class Scope {
public:
    explicit Scope(Budget& budget);
    explicit Scope(const Context& context);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

private:
    const Context before_;
};

/// Names this thread's work while the Stage lives. `of` must outlive it.
class Stage {
public:
    explicit Stage(const char* stage);
    Stage(const char* stage, const Place& place);
    Stage(const char* stage, Place (*place)(const void*), const void* of);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    const Work before_;
};

/// Number of exceeded budgets in the process that still exist.
inline constinit std::atomic<int> exceededBudgets{0};
void throwIfExceeded();

/// Throws Exceeded if this thread's budget is exceeded. Costs one relaxed load, so any loop may call it.
inline void check() {
    if (exceededBudgets.load(std::memory_order_relaxed) != 0) [[unlikely]]
        throwIfExceeded();
}

/// The same for loops whose bodies take a nanosecond: checks on every 4096th call.
class Check {
public:
    void operator()() {
        if ((++count_ & 4095u) == 0)
            check();
    }

private:
    unsigned count_ = 0;
};

/// Throws Exceeded if allocating `bytes` more would exceed this thread's limit. Call it before a single large
/// allocation; small sizes cost nothing.
void need(std::size_t bytes);

/// Reports the share of the stage that is done, in [0, 1], to this thread's budget.
void progress(double done);

/// Resident memory of this process in bytes, as the kernel says or, without /proc, as the allocator knows.
std::size_t residentBytes();

}  // namespace vtm::limits

#pragma GCC visibility pop

/// \file
/// Limits of time and memory for whatever the library is asked to do on a thread, a callback that shows
/// progress and may cancel, and where the work stands (docs/limits.md).
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

/// Where in a source file something stands. Lines and columns count from 1; 0 where unknown.
struct Place {
    std::uint32_t line = 0, column = 0;
    const char* element = "";  ///< its name, a string of static storage
};

enum class Limit { Seconds, Memory, Cancelled };

/// A limit was passed, or the callback cancelled. What was being made is lost, nothing else.
class Exceeded : public Error {
public:
    Exceeded(Limit limit, double value, std::string stage, Place place);
    Limit limit() const { return limit_; }
    double value() const { return value_; }              ///< of the limit: seconds or bytes
    const std::string& stage() const { return stage_; }  ///< "stroking"; may be empty
    const Place& place() const { return place_; }
    /// ` while stroking <path>`; empty where nothing is known.
    std::string during() const;

private:
    Limit limit_;
    double value_;
    std::string stage_;
    Place place_;
};

struct Progress {
    const char* stage = "";  ///< the last that any of the budget's threads began; may be empty
    double done = 0;         ///< share of that stage, in [0, 1]
    double seconds = 0;      ///< used up so far
    std::size_t bytes = 0;   ///< resident now
};

/// 0 and empty: no such limit.
struct Limits {
    /// CPU time of all threads of the process, or wall time, whichever is more, since the budget began.
    double seconds = 0;
    /// Resident memory of the whole process, what was there before included.
    std::size_t memoryBytes = 0;
    /// Called every 20 ms or so on a thread of the budget's own; false cancels. Must not throw.
    std::function<bool(const Progress&)> proceed = {};
    /// A last resort: called once on the budget's own thread if the budget still lives at `overrun` times a
    /// limit. `isEnding`: Exceeded was thrown, but not everything is given up yet; otherwise the work is in
    /// somebody else's code.
    std::function<void(const Exceeded&, bool isEnding)> overrunHandler = {};

    static constexpr double overrun = 1.08;
};

/// Limits that are being held. A thread of its own measures every few milliseconds.
class Budget {
public:
    explicit Budget(Limits limits);
    ~Budget();
    Budget(const Budget&) = delete;
    Budget& operator=(const Budget&) = delete;

    const Limits& limits() const { return limits_; }
    /// Used up since it began.
    double seconds() const;
    bool isExceeded() const { return state_.load(std::memory_order_relaxed) != held; }
    /// From another thread.
    void cancel() { stop(Limit::Cancelled); }

    // What follows is for the library itself.
    void throwIfExceeded() const;
    void need(std::size_t bytes);
    void begin(const char* stage) const;
    void progress(double done) const { done_.store(done, std::memory_order_relaxed); }

private:
    static constexpr int held = -1;
    void stop(Limit limit);
    void watch();
    void measure();
    void measureOverrun();
    Exceeded exceeded() const;
    double valueOf(Limit limit) const;

    const Limits limits_;
    const double startWall_, startCpu_;
    std::atomic<int> state_{held};  ///< a Limit, once one is passed
    mutable std::atomic<const char*> stage_{""};
    mutable std::atomic<double> done_{0};
    double lastCall_ = 0;
    bool overrun_ = false;
    mutable std::mutex thrownMutex_;
    mutable std::optional<Exceeded> thrown_;  ///< the first
    std::mutex mutex_;
    std::condition_variable ended_;
    bool isEnding_ = false;
    std::thread watcher_;
};

/// Where a thread's work stands: the stage, and a way to ask for the place only when it is wanted.
struct Work {
    const char* stage = "";
    Place (*place)(const void*) = nullptr;
    const void* of = nullptr;
};

/// What holds on a thread. For handing it on to threads that work for it.
struct Context {
    Budget* budget = nullptr;
    Work work;
};
Context current();

/// Holds a budget, or what held on another thread, on this thread for as long as it lives. Of several inside
/// each other the innermost holds. The budget must outlive it.
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

/// Says what this thread works at for as long as it lives. `of` must live as long.
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

/// Budgets in the process that are exceeded and not yet gone.
inline constinit std::atomic<int> exceededBudgets{0};
void throwIfExceeded();

/// Throws Exceeded if this thread's budget is used up. One relaxed load: it may stand in any loop.
inline void check() {
    if (exceededBudgets.load(std::memory_order_relaxed) != 0) [[unlikely]]
        throwIfExceeded();
}

/// The same, for loops whose bodies take a nanosecond: looks every 4096th time.
class Check {
public:
    void operator()() {
        if ((++count_ & 4095u) == 0)
            check();
    }

private:
    unsigned count_ = 0;
};

/// Throws Exceeded if so much more memory would pass this thread's limit. To be asked before single large
/// allocations; small sizes cost nothing.
void need(std::size_t bytes);

/// Tells this thread's budget which share of the stage is done.
void progress(double done);

/// Resident memory of this process in bytes, as the kernel says or, without /proc, as the allocator knows.
std::size_t residentBytes();

}  // namespace vtm::limits

#pragma GCC visibility pop

#include <vtm/limits/limits.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>

#include <fmt/format.h>

namespace vtm::limits {
namespace {

/// Often enough that what is allocated in between (some GB/s at most) is a small part of any useful limit.
constexpr std::chrono::milliseconds interval{4};

/// Seconds between two calls of Limits::proceed.
constexpr double callInterval = 0.02;

/// Smaller allocations are left to the watcher.
constexpr std::size_t largeBytes = 4u << 20;

double secondsOf(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
double wallSeconds() { return secondsOf(CLOCK_MONOTONIC); }
double cpuSeconds() { return secondsOf(CLOCK_PROCESS_CPUTIME_ID); }

thread_local constinit Context context;

/// The process's CPU time when the budget was found to be exceeded. A budget's watcher has a thread of its
/// own.
thread_local constinit double cpuAtStop = 0;

/// Beyond the limit, and after the work has had time on a processor to see it: where many wait for one, it
/// may have had none.
bool isLate(double used, double limit) {
    constexpr double toSee = 0.05;   // seconds
    constexpr double starved = 1.2;  // times the limit
    return limit > 0 && used > Limits::overrun * limit &&
           (cpuSeconds() - cpuAtStop > toSee || used > starved * limit);
}

Place placeItself(const void* place) { return *static_cast<const Place*>(place); }

Place placeOf(const Work& work) { return work.place ? work.place(work.of) : Place{}; }

std::string duringOf(const std::string& stage, const Place& place) {
    std::string text = stage.empty() ? "" : " while " + stage;
    if (*place.element)
        text += fmt::format("{} <{}>", stage.empty() ? " at" : "", place.element);
    return text;
}

std::string limitName(Limit limit, double value) {
    switch (limit) {
        case Limit::Seconds:
            return fmt::format("the limit of {:g} s was exceeded", value);
        case Limit::Memory:
            return fmt::format("the limit of {:g} MB of memory was exceeded", value / (1 << 20));
        case Limit::Cancelled:
            break;
    }
    return "was cancelled";
}

std::string message(Limit limit, double value, const std::string& stage, const Place& place) {
    const std::string where = place.line > 0 ? fmt::format("{}:{}: ", place.line, place.column) : "";
    return where + limitName(limit, value) + duringOf(stage, place);
}

bool needsWatcher(const Limits& l) { return l.seconds > 0 || l.memoryBytes > 0 || l.proceed; }

}  // namespace

Exceeded::Exceeded(Limit limit, double value, std::string stage, Place place)
    : Error(message(limit, value, stage, place)),
      limit_(limit),
      value_(value),
      stage_(std::move(stage)),
      place_(place) {}

std::string Exceeded::during() const { return duringOf(stage_, place_); }

Budget::Budget(Limits limits)
    : limits_(std::move(limits)), startWall_(wallSeconds()), startCpu_(cpuSeconds()) {
    if (needsWatcher(limits_))
        watcher_ = std::thread([this] { watch(); });
}

Budget::~Budget() {
    if (watcher_.joinable()) {
        {
            const std::lock_guard lock(mutex_);
            isEnding_ = true;
        }
        ended_.notify_one();
        watcher_.join();
    }
    if (isExceeded())
        exceededBudgets.fetch_sub(1);
}

double Budget::seconds() const { return std::max(wallSeconds() - startWall_, cpuSeconds() - startCpu_); }

double Budget::valueOf(Limit limit) const {
    switch (limit) {
        case Limit::Seconds:
            return limits_.seconds;
        case Limit::Memory:
            return static_cast<double>(limits_.memoryBytes);
        case Limit::Cancelled:
            break;
    }
    return 0;
}

/// For a thread that works, where it is; else where one of the budget's threads is.
Exceeded Budget::exceeded() const {
    const auto limit = static_cast<Limit>(state_.load());
    if (const Work& work = context.work; *work.stage)
        return {limit, valueOf(limit), work.stage, placeOf(work)};
    const std::lock_guard lock(lastMutex_);
    return {limit, valueOf(limit), *last_.stage ? last_.stage : stage_.load(), lastPlace_};
}

void Budget::throwIfExceeded() const {
    if (!isExceeded())
        return;
    const std::lock_guard lock(thrownMutex_);
    if (!thrown_)
        thrown_ = exceeded();
    throw *thrown_;
}

void Budget::stop(Limit limit) {
    int expected = held;
    if (state_.compare_exchange_strong(expected, static_cast<int>(limit)))
        exceededBudgets.fetch_add(1);
}

void Budget::need(std::size_t bytes) {
    if (limits_.memoryBytes == 0)
        return;
    if (bytes > limits_.memoryBytes || residentBytes() > limits_.memoryBytes - bytes)
        stop(Limit::Memory);
    throwIfExceeded();
}

void Budget::begin(const Work& work) const {
    if (limits_.overrunHandler) {
        const std::lock_guard lock(lastMutex_);
        keep(work);
    }
    if (stage_.load(std::memory_order_relaxed) == work.stage)
        return;  // another thread's, or the next part of it
    stage_.store(work.stage, std::memory_order_relaxed);
    done_.store(0, std::memory_order_relaxed);
}

void Budget::end(const Work& work, const Work& before) const {
    if (!limits_.overrunHandler)
        return;
    const std::lock_guard lock(lastMutex_);
    if (last_ == work)
        keep(before);
}

/// Places that must be looked for are not: the watcher may be asked for them later, on a thread of its own.
void Budget::keep(const Work& work) const {
    last_ = work;
    lastPlace_ = work.place == placeItself ? placeOf(work) : Place{};
}

void Budget::watch() {
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, interval, [this] { return isEnding_; })) {
        if (!isExceeded()) {
            measure();
            cpuAtStop = cpuSeconds();
        }
        measureOverrun();
    }
}

void Budget::measure() {
    const double used = seconds();
    if (limits_.seconds > 0 && used > limits_.seconds)
        stop(Limit::Seconds);
    if (limits_.memoryBytes > 0 && residentBytes() > limits_.memoryBytes)
        stop(Limit::Memory);
    if (limits_.proceed && used - lastCall_ >= callInterval) {
        lastCall_ = used;
        if (!limits_.proceed({stage_.load(), done_.load(), used, residentBytes()}))
            stop(Limit::Cancelled);
    }
}

void Budget::measureOverrun() {
    if (!limits_.overrunHandler || overrun_ || !isExceeded())
        return;
    const bool large =
        limits_.memoryBytes > 0 &&
        static_cast<double>(residentBytes()) > Limits::overrun * static_cast<double>(limits_.memoryBytes);
    overrun_ = isLate(seconds(), limits_.seconds) || large;
    if (!overrun_)
        return;
    const std::lock_guard lock(thrownMutex_);
    limits_.overrunHandler(thrown_.value_or(exceeded()), thrown_.has_value());
}

Context current() { return context; }

Scope::Scope(Budget& budget) : before_(context) { context.budget = &budget; }
Scope::Scope(const Context& handedOn) : before_(context) { context = handedOn; }
Scope::~Scope() { context = before_; }

Stage::Stage(const char* stage) : Stage(stage, nullptr, nullptr) {}
Stage::Stage(const char* stage, const Place& place) : Stage(stage, placeItself, &place) {}
Stage::Stage(const char* stage, Place (*place)(const void*), const void* of) : before_(context.work) {
    context.work = {stage, place, of};
    if (context.budget)
        context.budget->begin(context.work);
}
Stage::~Stage() {
    if (context.budget)
        context.budget->end(context.work, before_);
    context.work = before_;
}

void throwIfExceeded() {
    if (context.budget)
        context.budget->throwIfExceeded();
}

void need(std::size_t bytes) {
    if (bytes >= largeBytes && context.budget)
        context.budget->need(bytes);
}

void progress(double done) {
    if (context.budget)
        context.budget->progress(done);
}

}  // namespace vtm::limits

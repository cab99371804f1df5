#include <vtm/limits/limits.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace vtm::limits {
namespace {

/// Works until something stops it; returns what did.
Exceeded workUntilStopped() {
    try {
        for (;;)
            check();
    } catch (const Exceeded& e) {
        return e;
    }
}

TEST(Limits, NothingIsLimitedWithoutAScope) {
    Budget budget({.seconds = 1e-9});
    while (!budget.isExceeded())
        ;
    EXPECT_NO_THROW(check());
    EXPECT_NO_THROW(need(std::size_t{1} << 60));
}

TEST(Limits, SecondsEndWorkAndNameThePlace) {
    Budget budget({.seconds = 0.02});
    const Scope scope(budget);
    const Place place{3, 5, "path"};
    const Stage stage("stroking", place);
    const Exceeded stopped = workUntilStopped();
    EXPECT_EQ(stopped.limit(), Limit::Seconds);
    EXPECT_EQ(stopped.value(), 0.02);
    EXPECT_EQ(stopped.place().line, 3u);
    EXPECT_STREQ(stopped.what(), "3:5: the limit of 0.02 s was exceeded while stroking <path>");
    EXPECT_GE(budget.seconds(), 0.02);
}

TEST(Limits, MemoryEndsWork) {
    const std::size_t limit = residentBytes() + (32u << 20);
    Budget budget({.memoryBytes = limit});
    const Scope scope(budget);
    std::vector<std::vector<char>> held;
    EXPECT_THROW(
        for (;;) {
            check();
            held.emplace_back(1u << 16, 'x');
        },
        Exceeded);
}

TEST(Limits, LargeAllocationsAreAskedForBefore) {
    Budget budget({.memoryBytes = residentBytes() + (64u << 20)});
    const Scope scope(budget);
    EXPECT_NO_THROW(need(16u << 20));
    EXPECT_THROW(need(128u << 20), Exceeded);
    EXPECT_THROW(check(), Exceeded);
}

TEST(Limits, TheCallbackSeesProgressAndCancels) {
    std::atomic<double> seen{0};
    std::atomic<bool> named{false};
    Budget budget({.proceed = [&](const Progress& p) {
        seen = p.done;
        named = std::strcmp(p.stage, "counting") == 0;
        return p.done < 0.5;
    }});
    const Scope scope(budget);
    const Stage stage("counting");
    progress(0.75);
    const Exceeded stopped = workUntilStopped();
    EXPECT_EQ(stopped.limit(), Limit::Cancelled);
    EXPECT_EQ(seen, 0.75);
    EXPECT_TRUE(named);
}

TEST(Limits, CancelFromAnotherThread) {
    Budget budget({});
    std::thread other([&] { budget.cancel(); });
    const Scope scope(budget);
    EXPECT_EQ(workUntilStopped().limit(), Limit::Cancelled);
    other.join();
}

TEST(Limits, TheInnermostScopeHoldsAndTheOuterOneComesBack) {
    Budget outer({}), inner({});
    const Scope scope(outer);
    {
        const Scope inside(inner);
        outer.cancel();
        EXPECT_NO_THROW(check());
    }
    EXPECT_THROW(check(), Exceeded);
}

TEST(Limits, WhatHoldsIsHandedOnToOtherThreads) {
    Budget budget({});
    const Scope scope(budget);
    const Stage stage("drawing");
    budget.cancel();
    const Context context = current();
    std::string during;
    std::thread([&] {
        EXPECT_NO_THROW(check());
        const Scope here(context);
        during = workUntilStopped().during();
    }).join();
    EXPECT_EQ(during, " while drawing");
}

TEST(Limits, WorkThatDoesNotCheckIsReported) {
    std::atomic<bool> told{false};
    Budget budget({.seconds = 0.01,
                   .overrunHandler = [&](const Exceeded& e, bool) { told = e.limit() == Limit::Seconds; }});
    while (!told)
        ;
    EXPECT_GE(budget.seconds(), 0.01 * Limits::overrun);
}

/// A budget for work on this thread that does not check.
class UncheckedWork {
public:
    /// Waits for the overrunHandler.
    const std::string& told() const {
        while (!isTold_)
            ;
        return told_;
    }

private:
    std::atomic<bool> isTold_{false};
    std::string told_;
    // A busy machine must not keep the test from its stages so long.
    Budget budget_{{.seconds = 0.5, .overrunHandler = [this](const Exceeded& e, bool) {
                        told_ = e.what();
                        isTold_ = true;
                    }}};
    const Scope scope_{budget_};
};

constexpr Place svg{.line = 1, .column = 1, .element = "svg"},
    path{.line = 3, .column = 5, .element = "path"};

TEST(Limits, WorkThatDoesNotCheckIsReportedWithItsPlace) {
    const UncheckedWork work;
    const Stage compiling("compiling", svg);
    { const Stage ended("flattening", svg); }
    const Stage stroking("stroking", path);
    EXPECT_EQ(work.told(), "3:5: the limit of 0.5 s was exceeded while stroking <path>");
}

TEST(Limits, WorkThatDoesNotCheckIsReportedWhereWhatItBeganHasEnded) {
    const UncheckedWork work;
    const Stage compiling("compiling", svg);
    { const Stage stroking("stroking", path); }
    EXPECT_EQ(work.told(), "1:1: the limit of 0.5 s was exceeded while compiling <svg>");
}

TEST(Limits, ResidentMemoryFollowsWhatIsTouched) {
    const std::size_t before = residentBytes();
    const std::vector<char> block(64u << 20, 'x');
    EXPECT_GE(residentBytes(), before + (60u << 20));
}

}  // namespace
}  // namespace vtm::limits

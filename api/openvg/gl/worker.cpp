#include "api/openvg/gl/worker.hpp"

#include <exception>

#include <pthread.h>
#include <signal.h>

namespace vtm::openvg::gl {

namespace {

/// Jobs that may wait: their pixels and shares take memory.
constexpr std::size_t maxWaiting = 8;

/// A program's signals are not for its libraries' threads.
std::thread withoutSignals(std::function<void()> work) {
    sigset_t all, old;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    std::thread thread(std::move(work));
    pthread_sigmask(SIG_SETMASK, &old, nullptr);
    return thread;
}

}  // namespace

Worker::Worker() : thread_(withoutSignals([this] { work(); })) {}

Worker::~Worker() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    given_.notify_one();
    thread_.join();
}

void Worker::post(Job job) {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return jobs_.size() < maxWaiting; });
    jobs_.push_back(std::move(job));
    given_.notify_one();
}

void Worker::run(const Job& job) {
    std::exception_ptr thrown;
    bool isDone = false;
    post([&] {
        try {
            job();
        } catch (...) {
            thrown = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        isDone = true;
    });
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return isDone; });
    if (thrown)
        std::rethrow_exception(thrown);
}

void Worker::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        given_.wait(lock, [&] { return ends_ || !jobs_.empty(); });
        if (jobs_.empty())
            return;
        {
            const Job job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            job();
        }  // what the job holds goes without the lock
        lock.lock();
        done_.notify_all();
    }
}

}  // namespace vtm::openvg::gl

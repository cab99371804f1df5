/// \file
/// A thread that does one job after the other. OpenGL is called there only: which context is current in a
/// program's threads, and what is in it, does not concern us.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace vtm::openvg::gl {

class Worker {
public:
    using Job = std::function<void()>;

    Worker();
    /// Does what is left and ends the thread.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Does it some time. Waits first where too many jobs have been left.
    void post(Job job);
    /// Does it, and what was posted before; rethrows what it throws.
    void run(const Job& job);

private:
    void work();

    std::mutex mutex_;
    std::condition_variable given_, done_;
    std::deque<Job> jobs_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace vtm::openvg::gl

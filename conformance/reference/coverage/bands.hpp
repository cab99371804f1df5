/// \file
/// Rows of pixels, shared out among threads.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/outline/edges.hpp"

namespace vtm::reference {

/// Rows a thread takes at a time. A band's edges are found by a scan over all edges.
inline constexpr int bandHeight = 16;

/// Calls `work(first, end)` for bands that cover the rows [0, height), on all cores. `makeWork` makes
/// each thread its own. Rethrows the first exception.
template <class MakeWork>
void forEachBand(int height, const MakeWork& makeWork) {
    std::atomic<int> next{0};
    std::exception_ptr error;
    std::mutex errorMutex;
    const auto run = [&, holding = limits::current()] {
        const limits::Scope scope(holding);
        try {
            auto work = makeWork();
            for (int first = next.fetch_add(bandHeight); first < height; first = next.fetch_add(bandHeight))
                work(first, std::min(first + bandHeight, height));
        } catch (...) {
            const std::lock_guard lock(errorMutex);
            error = std::current_exception();
            next = height;
        }
    };
    std::vector<std::jthread> threads;
    const int bands = (height + bandHeight - 1) / bandHeight;
    const int wanted = std::min(bands, int(std::thread::hardware_concurrency()));
    for (int i = 1; i < wanted; ++i)
        threads.emplace_back(run);
    run();
    threads.clear();  // joins
    if (error)
        std::rethrow_exception(error);
}

/// The edges that meet the rows [first, end), in their order.
inline std::vector<Edge> edgesOfBand(std::span<const Edge> edges, int first, int end) {
    std::vector<Edge> found;
    for (const Edge& e : edges)
        if (e.y0 < end && e.y1 >= first)
            found.push_back(e);
    return found;
}

}  // namespace vtm::reference

/// \file
/// When drawing a view is worth several threads.
#pragma once

#include <cstddef>

#include <tbb/task_arena.h>

#include <vtm/raster/view.hpp>

namespace vtm::asset {

/// Waking threads that sleep costs as much as filling a million pixels with a solid colour, some tenths of a
/// millisecond. `edges`: what edges take, in such pixels.
inline bool areThreadsWorthIt(const View& view, bool hasPrograms, std::size_t edges) {
    constexpr std::size_t muchWork = 1u << 21, programPixel = 8;
    if (tbb::this_task_arena::max_concurrency() == 1)
        return false;
    const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
    return pixels * (hasPrograms ? programPixel : 1) + edges >= muchWork;
}

}  // namespace vtm::asset

/// \file
/// When drawing is worth several threads.
#pragma once

#include <cstddef>

#include <tbb/task_arena.h>

#include <vtm/raster/view.hpp>

namespace vtm::asset {

inline std::size_t pixelsIn(const View& view) { return std::size_t(view.width) * std::size_t(view.height); }

/// Waking threads that sleep costs as much as filling a million pixels with a solid colour, some tenths of a
/// millisecond. `pixels`: how many are filled; `edges`: what edges take, in pixels of such a colour.
inline bool areThreadsWorthIt(std::size_t pixels, bool hasPrograms, std::size_t edges) {
    constexpr std::size_t muchWork = 1u << 21, programPixel = 8;
    if (tbb::this_task_arena::max_concurrency() == 1)
        return false;
    return pixels * (hasPrograms ? programPixel : 1) + edges >= muchWork;
}

}  // namespace vtm::asset

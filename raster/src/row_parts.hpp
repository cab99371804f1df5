/// \file
/// Pictures by some of their rows at a time, on all processors.
#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/pixel_box.hpp>

namespace vtm::asset {

/// Calls draw(part) for boxes of some of its rows each, whole and together all of them: by several threads at
/// once where there are many pixels. What a row becomes must not depend on the others.
template <class Draw>
void byRows(const PixelBox& box, const Draw& draw) {
    constexpr std::size_t pixelsOfPart = 1u << 15;
    if (box.empty())
        return;
    const auto rowsOfPart = std::max<std::size_t>(1, pixelsOfPart / std::size_t(box.width()));
    if (std::size_t(box.height()) < 2 * rowsOfPart)
        return draw(box);
    tbb::parallel_for(tbb::blocked_range<int>(box.min.y, box.max.y, rowsOfPart),
                      [&, holding = limits::current()](const tbb::blocked_range<int>& rows) {
                          const limits::Scope scope(holding);
                          draw(PixelBox{{box.min.x, rows.begin()}, {box.max.x, rows.end()}});
                      });
}

/// Calls draw(y) for each of its rows, likewise.
template <class Draw>
void eachRow(const PixelBox& box, const Draw& draw) {
    byRows(box, [&](const PixelBox& part) {
        for (int y = part.min.y; y < part.max.y; ++y)
            draw(y);
    });
}

}  // namespace vtm::asset

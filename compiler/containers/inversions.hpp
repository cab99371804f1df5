/// \file
/// Inversions of a sequence: pairs of which the first is greater than the second.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vtm::compiler {

/// Whether there are more than `most`. Sorts the values, unless there are; `spare` keeps its memory.
template <class T>
bool hasMoreInversions(std::vector<T>& values, std::vector<T>& spare, std::size_t most) {
    if (std::ranges::is_sorted(values))
        return false;
    // Merge sort, which counts what it puts past others.
    const std::size_t count = values.size();
    spare.resize(count);
    std::size_t inversions = 0;
    for (std::size_t width = 1; width < count; width *= 2) {
        for (std::size_t from = 0; from < count; from += 2 * width) {
            const std::size_t middle = std::min(from + width, count),
                              stop = std::min(from + 2 * width, count);
            std::size_t i = from, k = middle, to = from;
            while (i < middle && k < stop)
                if (values[k] < values[i]) {
                    inversions += middle - i;
                    spare[to++] = values[k++];
                } else {
                    spare[to++] = values[i++];
                }
            std::copy(values.begin() + std::ptrdiff_t(i), values.begin() + std::ptrdiff_t(middle),
                      spare.begin() + std::ptrdiff_t(to));
            to += middle - i;
            std::copy(values.begin() + std::ptrdiff_t(k), values.begin() + std::ptrdiff_t(stop),
                      spare.begin() + std::ptrdiff_t(to));
        }
        values.swap(spare);
        if (inversions > most)
            return true;
    }
    return false;
}

}  // namespace vtm::compiler

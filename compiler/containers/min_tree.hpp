/// \file
/// The least of many numbers that change one by one.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <vector>

namespace vtm::compiler {

/// A tournament: each node has the least of its two children, the leaves are the numbers.
class MinTree {
public:
    /// Sets all of `count` numbers, at least one, to valueOf(i).
    template <class ValueOf>
    void assign(std::size_t count, const ValueOf& valueOf) {
        leaves_ = std::bit_ceil(count);
        nodes_.resize(2 * leaves_);
        for (std::size_t i = 0; i < leaves_; ++i)
            nodes_[leaves_ + i] = i < count ? valueOf(i) : std::numeric_limits<float>::infinity();
        for (std::size_t i = leaves_; i-- > 1;)
            nodes_[i] = std::min(nodes_[2 * i], nodes_[2 * i + 1]);
    }
    void set(std::size_t index, float value) {
        std::size_t i = leaves_ + index;
        nodes_[i] = value;
        for (i /= 2; i > 0; i /= 2)
            nodes_[i] = std::min(nodes_[2 * i], nodes_[2 * i + 1]);
    }
    float least() const { return nodes_[1]; }
    /// Of equal ones the first.
    std::size_t indexOfLeast() const {
        std::size_t i = 1;
        while (i < leaves_)
            i = 2 * i + (nodes_[2 * i] > nodes_[i]);
        return i - leaves_;
    }

private:
    std::size_t leaves_ = 0;
    std::vector<float> nodes_;  ///< from 1 on
};

}  // namespace vtm::compiler

/// \file
/// Boxes of whole pixels.
#pragma once

#include <cstddef>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace vtm::asset {

/// Pixels [min, max) of a raster.
struct PixelBox {
    glm::ivec2 min{0}, max{0};

    bool empty() const { return min.x >= max.x || min.y >= max.y; }
    glm::ivec2 size() const { return max - min; }
    int width() const { return empty() ? 0 : max.x - min.x; }
    int height() const { return empty() ? 0 : max.y - min.y; }
    std::size_t area() const { return std::size_t(width()) * std::size_t(height()); }
    bool contains(int x, int y) const { return x >= min.x && x < max.x && y >= min.y && y < max.y; }
    PixelBox intersection(const PixelBox& other) const {
        const PixelBox both{glm::max(min, other.min), glm::min(max, other.max)};
        return both.empty() ? PixelBox{} : both;
    }
    /// The least box round both.
    PixelBox joined(const PixelBox& other) const {
        if (empty() || other.empty())
            return empty() ? other : *this;
        return {glm::min(min, other.min), glm::max(max, other.max)};
    }
    PixelBox moved(glm::ivec2 by) const { return {min + by, max + by}; }
    PixelBox grown(glm::ivec2 by) const { return {min - by, max + by}; }
};

}  // namespace vtm::asset

/// \file
/// Packing rectangles into a target, left to right on shelves.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

namespace vtm::gl {

class Shelves {
public:
    explicit Shelves(glm::ivec2 size) : size_(size) {}

    /// The rectangle's min corner, or nothing where no room is left.
    std::optional<glm::ivec2> place(glm::ivec2 rectangle);
    /// All that was placed lies in rows [0, height()).
    int height() const { return shelf_ + shelfHeight_; }
    void clear();

private:
    glm::ivec2 size_;
    int x_ = 0, shelf_ = 0, shelfHeight_ = 0;
};

}  // namespace vtm::gl

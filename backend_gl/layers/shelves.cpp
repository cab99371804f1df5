#include "backend_gl/layers/shelves.hpp"

#include <algorithm>

namespace vtm::gl {

std::optional<glm::ivec2> Shelves::place(glm::ivec2 rectangle) {
    const bool newShelf = x_ + rectangle.x > size_.x;
    const int y = newShelf ? height() : shelf_;
    if (rectangle.x > size_.x || y + rectangle.y > size_.y)
        return std::nullopt;
    if (newShelf) {
        shelf_ = y;
        shelfHeight_ = 0;
        x_ = 0;
    }
    const glm::ivec2 place(x_, shelf_);
    x_ += rectangle.x;
    shelfHeight_ = std::max(shelfHeight_, rectangle.y);
    return place;
}

void Shelves::clear() { x_ = shelf_ = shelfHeight_ = 0; }

}  // namespace vtm::gl

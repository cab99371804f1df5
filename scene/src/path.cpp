#include "scene/path.hpp"

namespace vtm::scene {

Path rectangle(Point min, Point max) {
    return {MoveTo{min}, LineTo{{max.x, min.y}}, LineTo{max}, LineTo{{min.x, max.y}}, Close{}};
}

}  // namespace vtm::scene

#include "geometry/box.hpp"

#include <initializer_list>

namespace vtm::geometry {

Box mapped(const Box& box, const glm::dmat3x2& map) {
    Box result;
    if (box.empty())
        return result;
    for (const Point p : {box.min, Point(box.max.x, box.min.y), box.max, Point(box.min.x, box.max.y)})
        result.add(map[0] * p.x + map[1] * p.y + map[2]);
    return result;
}

}  // namespace vtm::geometry

#include <vtm/scene/path.hpp>

namespace vtm::scene {

Path rectangle(Point min, Point max) {
    return {MoveTo{min}, LineTo{{max.x, min.y}}, LineTo{max}, LineTo{{min.x, max.y}}, Close{}};
}

Path polygon(const std::vector<Point>& points) {
    Path path{MoveTo{points.front()}};
    for (std::size_t i = 1; i < points.size(); ++i)
        path.push_back(LineTo{points[i]});
    path.push_back(Close{});
    return path;
}

std::optional<Point> endOf(const Command& command) {
    return std::visit(
        [](const auto& c) -> std::optional<Point> {
            if constexpr (requires { c.to; })
                return c.to;
            else
                return std::nullopt;
        },
        command);
}

}  // namespace vtm::scene

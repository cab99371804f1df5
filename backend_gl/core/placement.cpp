#include "backend_gl/core/placement.hpp"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace vtm::gl {

namespace {

using glm::dvec2;

constexpr double unitsPerSide = double(1u << (2 * asset::maxLevel));

glm::dmat2 linearOf(const asset::View& view) { return {view.toPixels[0], view.toPixels[1]}; }

dvec2 viewCentre(const asset::View& view) {
    return glm::inverse(linearOf(view)) * (dvec2(view.width, view.height) * 0.5 - view.toPixels[2]);
}

}  // namespace

PixelBox pixelsOf(const DrawnMask& drawn, const asset::Map& map, const asset::View& view) {
    if (drawn.min.x >= drawn.max.x)
        return {};
    const double unit = map.side / unitsPerSide;
    const dvec2 corner = dvec2(map.x, map.y) + dvec2(drawn.min) * unit;
    const dvec2 size = dvec2(drawn.max - drawn.min) * unit, zero(0), raster(view.width, view.height);
    const dvec2 origin = view.toPixels * glm::dvec3(corner, 1);
    const dvec2 x = view.toPixels[0] * size.x, y = view.toPixels[1] * size.y;
    const dvec2 minimum = origin + glm::min(x, zero) + glm::min(y, zero);
    const dvec2 maximum = origin + glm::max(x, zero) + glm::max(y, zero);
    return {glm::ivec2(glm::clamp(glm::floor(minimum), zero, raster)),
            glm::ivec2(glm::clamp(glm::ceil(maximum), zero, raster))};
}

Placement placementOf(const asset::Map& map, const asset::View& view, glm::ivec2 shift, const PixelBox& box) {
    const double unit = map.side / unitsPerSide;
    const dvec2 corner(map.x, map.y);
    const dvec2 base =
        glm::clamp(glm::round((viewCentre(view) - corner) / unit), dvec2(0), dvec2(unitsPerSide));
    const dvec2 pixel = view.toPixels * glm::dvec3(corner + base * unit, 1) + dvec2(shift);
    const dvec2 x = view.toPixels[0] * unit, y = view.toPixels[1] * unit;
    return {{float(x.x), float(x.y), float(y.x), float(y.y)},
            {float(pixel.x), float(pixel.y)},
            {float(base.x), float(base.y)},
            {float(box.min.x), float(box.min.y), float(box.max.x), float(box.max.y)},
            {}};
}

bool isInvertible(const asset::View& view) {
    const double determinant = glm::determinant(linearOf(view));
    return std::abs(determinant) > std::numeric_limits<double>::min();
}

}  // namespace vtm::gl

#include <vtm/scene/affine.hpp>

#include <cmath>

namespace vtm::scene {

Affine compose(const Affine& outer, const Affine& inner) {
    return {applyVector(outer, inner[0]), applyVector(outer, inner[1]), apply(outer, inner[2])};
}

double determinant(const Affine& m) { return m[0].x * m[1].y - m[1].x * m[0].y; }

std::optional<Affine> inverse(const Affine& m) {
    const double det = determinant(m);
    if (det == 0 || !std::isfinite(1 / det))
        return std::nullopt;
    const glm::dvec2 x{m[1].y / det, -m[0].y / det};
    const glm::dvec2 y{-m[1].x / det, m[0].x / det};
    const Affine inverse{x, y, -(x * m[2].x + y * m[2].y)};
    for (int column = 0; column < 3; ++column)
        if (!std::isfinite(inverse[column].x) || !std::isfinite(inverse[column].y))
            return std::nullopt;
    return inverse;
}

Affine translation(double x, double y) { return {1, 0, 0, 1, x, y}; }

Affine scaling(double x, double y) { return {x, 0, 0, y, 0, 0}; }

}  // namespace vtm::scene

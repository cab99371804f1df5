// Filter Effects Module Level 1, sections 9.9, 9.20 and 9.22: light on a surface.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "conformance/reference/filter/operations.hpp"

namespace vtm::reference {
namespace {

using glm::dvec3;

constexpr double radians = std::numbers::pi / 180;

/// The table of normals: by place in the region, factors and kernels.
class Normals {
public:
    Normals(const Pixels& input, const Rectangle& region, double scale) : input_(input), scale_(scale) {
        constexpr double rounding = 1e-6;
        left_ = int(std::floor(region.min.x + rounding));
        top_ = int(std::floor(region.min.y + rounding));
        right_ = int(std::ceil(region.max.x - rounding)) - 1;
        bottom_ = int(std::ceil(region.max.y - rounding)) - 1;
    }

    dvec3 at(int x, int y) const {
        return glm::normalize(dvec3(-scale_ * slope(x, y, true), -scale_ * slope(x, y, false), 1));
    }

private:
    using Kernel = std::array<std::array<double, 3>, 3>;  ///< by row, column

    double slope(int x, int y, bool alongX) const {
        const int column = x <= left_ ? -1 : x >= right_ ? 1 : 0, row = y <= top_ ? -1 : y >= bottom_ ? 1 : 0;
        const int along = alongX ? column : row, across = alongX ? row : column;
        // Differences along the axis: over the pixel itself and its neighbours, or those that there are.
        const std::array<double, 3> difference = along < 0   ? std::array<double, 3>{0, -1, 1}
                                                 : along > 0 ? std::array<double, 3>{-1, 1, 0}
                                                             : std::array<double, 3>{-1, 0, 1};
        const std::array<double, 3> weights = across < 0   ? std::array<double, 3>{0, 2, 1}
                                              : across > 0 ? std::array<double, 3>{1, 2, 0}
                                                           : std::array<double, 3>{1, 2, 1};
        // 1/4 inside, 1/3 or 1/2 at a side, 2/3 in a corner.
        const double factor =
            along == 0 ? (across == 0 ? 1.0 / 4 : 1.0 / 3) : (across == 0 ? 1.0 / 2 : 2.0 / 3);
        double sum = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double share = alongX ? difference[std::size_t(j)] * weights[std::size_t(i)]
                                            : difference[std::size_t(i)] * weights[std::size_t(j)];
                if (share != 0)
                    sum += share * input_.get(x + j - 1, y + i - 1).a;
            }
        return factor * sum;
    }

    const Pixels& input_;
    double scale_;
    int left_, top_, right_, bottom_;
};

dvec3 inPixels(const std::array<float, 3>& p, const Frame& frame) {
    const glm::dvec2 xy = frame.pixel({p[0], p[1]});
    return {xy.x, xy.y,
            p[2] * std::sqrt((frame.scale.x * frame.scale.x + frame.scale.y * frame.scale.y) / 2)};
}

struct Arriving {
    dvec3 from;    ///< direction to the light
    double share;  ///< of its colour
};

Arriving arriving(const scene::DistantLight& l, const dvec3&, const Frame&) {
    const double a = l.azimuth * radians, e = l.elevation * radians;
    return {{std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)}, 1};
}

Arriving arriving(const scene::PointLight& l, const dvec3& place, const Frame& frame) {
    return {glm::normalize(inPixels(l.position, frame) - place), 1};
}

Arriving arriving(const scene::SpotLight& l, const dvec3& place, const Frame& frame) {
    const dvec3 position = inPixels(l.position, frame), axis = inPixels(l.pointsAt, frame) - position;
    const dvec3 from = glm::normalize(position - place);
    if (glm::length(axis) == 0)
        return {from, 0};
    const double along = -glm::dot(from, glm::normalize(axis));
    if (along <= 0)
        return {from, 0};
    double share = std::pow(along, double(l.exponent));
    const double cone = std::abs(l.coneAngle);
    if (cone < 180) {
        // The edge of the cone, smoothed over a pixel.
        const double step =
            std::sqrt(std::max(0.0, 1 - along * along)) / std::max(1.0, glm::length(position - place));
        share *= std::clamp((along - std::cos(cone * radians)) / std::max(step, 1e-6) + 0.5, 0.0, 1.0);
    }
    return {from, share};
}

}  // namespace

Pixels operate(const scene::LightingFilter& f, const Reading& in, Pixels result) {
    const Normals normals(in.inputs[0], in.regions[0], f.surfaceScale);
    Colour colour(f.color.r, f.color.g, f.color.b, 1);
    if (in.linear)
        colour = linearised(colour);
    result.fill([&](int x, int y) {
        const dvec3 normal = normals.at(x, y);
        const dvec3 place(x + 0.5, y + 0.5, f.surfaceScale * in.inputs[0].get(x, y).a);
        const Arriving light =
            std::visit([&](const auto& l) { return arriving(l, place, in.frame); }, f.light);
        double amount = 0;
        if (f.specular) {
            const dvec3 half = light.from + dvec3(0, 0, 1);
            const double along = glm::length(half) > 0 ? glm::dot(normal, glm::normalize(half)) : 0;
            amount = along > 0 ? std::pow(along, double(f.exponent)) : 0;
        } else {
            amount = std::max(0.0, glm::dot(normal, light.from));
        }
        const Colour lit = glm::clamp(colour * (f.constant * amount * light.share), 0.0, 1.0);
        return Colour(lit.r, lit.g, lit.b, f.specular ? std::max({lit.r, lit.g, lit.b}) : 1.0);
    });
    return result;
}

}  // namespace vtm::reference

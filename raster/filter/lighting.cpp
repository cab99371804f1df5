// Light on a surface whose height is the alpha of a picture. The surface's units are pixels, as the
// specification has it where no kernelUnitLength says otherwise.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <vtm/limits/limits.hpp>
#include "raster/filter/curves.hpp"
#include "raster/filter/operations.hpp"

namespace vtm::asset {

namespace {

using glm::vec3;

/// Sobel's kernels, and those of the specification's table at the border of the input's region.
class Surface {
public:
    Surface(const Layer& layer, const PixelBox& region, float scale)
        : layer_(layer), region_(region), scale_(scale) {}

    float height(int x, int y) const { return scale_ * alpha(x, y); }

    vec3 normal(int x, int y) const {
        const int left = x > region_.min.x ? -1 : 0, right = x < region_.max.x - 1 ? 1 : 0;
        const int top = y > region_.min.y ? -1 : 0, bottom = y < region_.max.y - 1 ? 1 : 0;
        float slopeX = 0, slopeY = 0, weightX = 0, weightY = 0;
        for (int dy = top; dy <= bottom; ++dy) {
            const float weight = dy == 0 ? 2.0f : 1.0f;
            slopeX += weight * (alpha(x + right, y + dy) - alpha(x + left, y + dy));
            weightX += weight;
        }
        for (int dx = left; dx <= right; ++dx) {
            const float weight = dx == 0 ? 2.0f : 1.0f;
            slopeY += weight * (alpha(x + dx, y + bottom) - alpha(x + dx, y + top));
            weightY += weight;
        }
        // The table's factors: differences over two pixels, the mean of them.
        const float factorX = 2 / (weightX * std::max(1.0f, float(right - left))),
                    factorY = 2 / (weightY * std::max(1.0f, float(bottom - top)));
        return glm::normalize(vec3(-scale_ * factorX * slopeX, -scale_ * factorY * slopeY, 1));
    }

private:
    float alpha(int x, int y) const { return layer_.at(x, y)[3]; }

    const Layer& layer_;
    const PixelBox region_;
    const float scale_;
};

/// From a point of the surface to the light, and how much of its colour arrives.
class Light {
public:
    explicit Light(const FilterStep& step)
        : kind_(LightKind(int(step.parameters[7]))),
          position_(point(step, 8)),
          exponent_(step.parameters[14]) {
        const FilterParameters& p = step.parameters;
        constexpr float radians = std::numbers::pi_v<float> / 180;
        if (kind_ == LightKind::Distant) {
            const float azimuth = p[8] * radians, elevation = p[9] * radians;
            direction_ = {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                          std::sin(elevation)};
        }
        const vec3 axis = point(step, 11) - position_;
        axis_ = glm::length(axis) > 0 ? glm::normalize(axis) : vec3(0);
        const float cone = std::abs(p[15]);
        hasCone_ = cone < 180;
        coneCosine_ = std::cos(cone * radians);
    }

    vec3 from(vec3 place) const {
        if (kind_ == LightKind::Distant)
            return direction_;
        const vec3 to = position_ - place;
        const float length = glm::length(to);
        return length > 0 ? to / length : vec3(0, 0, 1);
    }

    float distance(vec3 place) const { return glm::length(position_ - place); }

    /// Of the light that comes from direction `to`, so many pixels away.
    float share(vec3 to, float distance) const {
        if (kind_ != LightKind::Spot)
            return 1;
        const float along = -glm::dot(to, axis_);
        if (along <= 0)
            return 0;
        const float power = std::pow(along, exponent_);
        if (!hasCone_)
            return power;
        // The cone's border is smoothed over a pixel: so much the cosine changes from one to the next.
        const float sine = std::sqrt(std::max(0.0f, 1 - along * along));
        const float smooth = std::max(sine / std::max(distance, 1.0f), 1e-6f);
        return power * std::clamp((along - coneCosine_) / smooth + 0.5f, 0.0f, 1.0f);
    }

private:
    static vec3 point(const FilterStep& step, std::size_t first) {
        const FilterParameters& p = step.parameters;
        const double mean = std::sqrt((step.scale.x * step.scale.x + step.scale.y * step.scale.y) / 2);
        return {float(p[first] * step.scale.x + step.origin.x),
                float(p[first + 1] * step.scale.y + step.origin.y), float(p[first + 2] * mean)};
    }

    LightKind kind_;
    vec3 position_, axis_{0}, direction_{0, 0, 1};
    float exponent_;
    bool hasCone_ = false;
    float coneCosine_ = -1;
};

}  // namespace

Layer lighting(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const bool specular = p[0] != 0;
    const float constant = p[2], exponent = p[3];
    vec3 color(p[4], p[5], p[6]);
    if (step.linear)
        color = {decodingCurve()(color.r), decodingCurve()(color.g), decodingCurve()(color.b)};
    const Surface surface(*step.inputs[0], step.regions[0].pixels(), p[1]);
    const Light light(step);
    Layer result(step.box, step.linear);
    for (int y = step.box.min.y; y < step.box.max.y && !result.empty(); ++y) {
        limits::check();
        for (int x = step.box.min.x; x < step.box.max.x; ++x) {
            const vec3 normal = surface.normal(x, y);
            const vec3 place(float(x) + 0.5f, float(y) + 0.5f, surface.height(x, y));
            const vec3 to = light.from(place);
            float amount = 0;
            if (!specular) {
                amount = std::max(0.0f, glm::dot(normal, to));
            } else {
                const vec3 half = to + vec3(0, 0, 1);
                const float length = glm::length(half);
                const float along = length > 0 ? glm::dot(normal, half) / length : 0.0f;
                amount = along > 0 ? std::pow(along, exponent) : 0.0f;
            }
            const vec3 lit =
                glm::clamp(constant * amount * light.share(to, light.distance(place)) * color, 0.0f, 1.0f);
            const float alpha = specular ? std::max({lit.r, lit.g, lit.b}) : 1.0f;
            result.row(y)[x - step.box.min.x] = Float4{lit.r, lit.g, lit.b, alpha};
        }
    }
    return result;
}

}  // namespace vtm::asset

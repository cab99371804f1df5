#include "asset/src/gradient.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace vtm::asset {

namespace {

using glm::vec2;
using glm::vec4;

float spreadOffset(Spread spread, float u) {
    switch (spread) {
        case Spread::Reflect:
            return 1 - std::abs(1 - (u - 2 * std::floor(u / 2)));
        case Spread::Repeat:
            return u - std::floor(u);
        default:
            return std::clamp(u, 0.0f, 1.0f);
    }
}

vec4 unpack(const GradientStop& stop) {
    return vec4(stop.rgba[0], stop.rgba[1], stop.rgba[2], stop.rgba[3]) / 65535.0f;
}

/// How many stops have an offset <= u; of several at one offset the last counts from there on.
std::size_t stopsUpTo(const GradientView& gradient, float u) {
    std::size_t low = 0, high = gradient.size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (gradient.stop(middle).offset <= u)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// Straight colours are interpolated, then premultiplied (SVG 2 section 14.2.4).
vec4 colorAt(const GradientView& gradient, float u) {
    const std::size_t upTo = stopsUpTo(gradient, u);
    const GradientStop before = gradient.stop(upTo == 0 ? 0 : upTo - 1);
    const GradientStop after = gradient.stop(std::min(upTo, gradient.size() - 1));
    const float gap = after.offset - before.offset;
    const vec4 c = glm::mix(unpack(before), unpack(after), gap > 0 ? (u - before.offset) / gap : 0.0f);
    return {glm::vec3(c) * c.a, c.a};
}

struct Root {
    float u = 0;
    bool real = false;
};

/// The larger root u of |p - (1-u) f| = (1-u) fr + u with (1-u) fr + u >= 0. With d = p - f it is
/// a u² - 2 b u - c = 0, a = (1-fr)² - |f|², b = d·f - fr (1-fr), c = |d|² - fr²; its roots are q / a
/// and -c / q with q = b ± sqrt(b² + a c), the sign chosen so that nothing cancels.
Root radialOffset(vec2 p, vec2 f, float fr) {
    const vec2 d = p - f;
    const float grow = 1 - fr;
    const float a = grow * grow - glm::dot(f, f), b = glm::dot(d, f) - fr * grow;
    const float c = glm::dot(d, d) - fr * fr, discriminant = b * b + a * c;
    if (discriminant < 0)
        return {};
    const float q = b + (b < 0 ? -1.0f : 1.0f) * std::sqrt(discriminant);
    const float one = q == 0 ? 0 : -c / q, other = a == 0 ? one : q / a;
    const float larger = std::max(one, other), smaller = std::min(one, other);
    if (fr + larger * grow >= 0)
        return {larger, true};
    return {smaller, fr + smaller * grow >= 0};
}

}  // namespace

vec4 linearColor(const GradientView& view, vec2 point) {
    const Gradient& gradient = view.gradient();
    return colorAt(view, spreadOffset(gradient.spread, applyMatrix(gradient.matrix, point).x));
}

vec4 radialColor(const GradientView& view, vec2 point) {
    const Gradient& gradient = view.gradient();
    const Root root =
        radialOffset(applyMatrix(gradient.matrix, point), {gradient.fx, gradient.fy}, gradient.fr);
    return root.real ? colorAt(view, spreadOffset(gradient.spread, root.u)) : vec4(0);
}

}  // namespace vtm::asset

#include "examples/openvg/lake.hpp"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lake {

namespace {

using glm::vec2, glm::vec3;

constexpr float shore = 0.3f;  // p: x in [0, 1.5], y in [0, 1], upwards

vec3 skyAt(vec2 p) {
    const float up = (p.y - shore) / (1 - shore);
    const vec3 low{1.0f, 0.66f, 0.36f}, middle{0.86f, 0.36f, 0.45f}, high{0.16f, 0.2f, 0.46f};
    const vec3 sky =
        up < 0.35f ? glm::mix(low, middle, up / 0.35f) : glm::mix(middle, high, (up - 0.35f) / 0.65f);
    const float distance = glm::length(p - vec2(0.98f, 0.47f));
    const vec3 glow = vec3(1, 0.75f, 0.4f) * 0.5f * std::exp(-distance * 6);
    return glm::mix(glm::min(sky + glow, vec3(1)), vec3(1, 0.96f, 0.8f),
                    glm::smoothstep(0.088f, 0.082f, distance));
}

/// The height of the ridge of a range, 0 the farthest.
float ridge(int range, float x) {
    const float k = float(range);
    return shore + 0.22f - 0.075f * k + 0.06f * std::sin(x * (5 + 2 * k) + k * 2) +
           0.03f * std::sin(x * (13 + 5 * k) + k) + 0.008f * std::sin(x * (47 + 9 * k));
}

/// Whether the balloon about `middle` covers p, and its colour there.
bool balloonAt(vec2 p, vec2 middle, float radius, vec3 one, vec3 other, vec3& color) {
    const vec2 q = (p - middle) / radius;
    const float squeeze = q.y < 0 ? 1 + 0.35f * q.y : 1;  // narrower towards the basket
    if (std::abs(q.x) < 0.2f && q.y < -1.35f && q.y > -1.65f) {
        color = {0.35f, 0.2f, 0.12f};
        return true;
    }
    const float across = q.x / squeeze;
    if (across * across + q.y * q.y / 1.25f > 1)
        return false;
    const float turn = std::asin(glm::clamp(across / std::sqrt(1 - q.y * q.y / 1.3f), -1.0f, 1.0f));
    const bool odd = int(std::floor(turn * 2.2f + 8)) % 2 != 0;
    color = (odd ? one : other) * (0.72f + 0.28f * glm::clamp(0.6f + 0.6f * across + 0.3f * q.y, 0.0f, 1.0f));
    return true;
}

vec3 above(vec2 p) {
    vec3 color;
    if (balloonAt(p, {0.36f, 0.68f}, 0.17f, {0.95f, 0.25f, 0.2f}, {1, 0.93f, 0.8f}, color) ||
        balloonAt(p, {1.24f, 0.8f}, 0.085f, {0.1f, 0.55f, 0.6f}, {1, 0.8f, 0.3f}, color) ||
        balloonAt(p, {0.72f, 0.87f}, 0.05f, {0.55f, 0.25f, 0.6f}, {1, 0.85f, 0.75f}, color))
        return color;
    color = skyAt(p);
    for (int range = 0; range < 3; ++range)
        if (p.y < ridge(range, p.x))
            color = glm::mix(vec3(0.55f, 0.3f, 0.47f), vec3(0.1f, 0.12f, 0.25f), float(range) / 2);
    return color;
}

vec3 colorAt(vec2 p) {
    if (p.y >= shore)
        return above(p);
    const float depth = shore - p.y;  // the lake shows it all again, wavy and darker
    const float wave = 0.012f * std::sin(depth * 160 / (0.3f + 2 * depth)) * (0.4f + 3 * depth);
    const vec3 mirrored = above({p.x + wave, shore + depth * 1.6f});
    return glm::mix(mirrored, vec3(0.1f, 0.16f, 0.35f), 0.28f + 0.8f * depth);
}

}  // namespace

std::vector<std::uint32_t> picture(int width, int height) {
    constexpr int samples = 3;  // in each direction
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            vec3 sum{0};
            for (int i = 0; i < samples * samples; ++i) {
                const vec2 inside = (vec2(i % samples, i / samples) + 0.5f) / float(samples);
                sum += colorAt((vec2(x, y) + inside) / float(height));
            }
            const vec3 bytes = glm::clamp(sum / float(samples * samples), 0.0f, 1.0f) * 255.0f + 0.5f;
            pixels.push_back(std::uint32_t(bytes.r) << 24 | std::uint32_t(bytes.g) << 16 |
                             std::uint32_t(bytes.b) << 8 | 0xff);
        }
    return pixels;
}

}  // namespace lake

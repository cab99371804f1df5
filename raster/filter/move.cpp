// Operations that show their input elsewhere.

#include <algorithm>
#include <cmath>

#include <vtm/limits/limits.hpp>
#include "raster/filter/curves.hpp"
#include "raster/filter/operations.hpp"

namespace vtm::asset {

namespace {

/// read(x, y) at the centre of each pixel of a box, beyond which the result is transparent.
template <class Read>
Layer madeOf(const FilterStep& step, const PixelBox& box, Read read) {
    Layer result = Layer::unwritten(box.intersection(step.box), step.linear);
    for (int y = result.box.min.y; y < result.box.max.y && !result.empty(); ++y) {
        limits::check();
        Float4* row = result.row(y);
        for (int x = result.box.min.x; x < result.box.max.x; ++x)
            *row++ = read(x, y);
    }
    return result;
}

/// Each pixel of a box as it is in the input at the place of its centre plus `by`.
Layer betweenPixels(const Layer& input, glm::dvec2 by, const PixelBox& box, const FilterStep& step) {
    Layer result = Layer::unwritten(box.intersection(step.box), step.linear);
    const glm::dvec2 whole = glm::floor(by);
    const glm::vec2 part(by - whole);
    PixelBox read = result.box.moved(glm::ivec2(whole));
    read.max += 1;
    LayerRows uppers(input, read), lowers(input, read);
    for (int y = result.box.min.y; y < result.box.max.y && !result.empty(); ++y) {
        limits::check();
        const Float4* const upper = uppers(y + int(whole.y));
        const Float4* const lower = lowers(y + int(whole.y) + 1);
        const auto between = [&](int i) { return upper[i] + part.y * (lower[i] - upper[i]); };
        Float4* const row = result.row(y);
        Float4 left = between(0);
        for (int i = 0; i < result.width(); ++i) {
            const Float4 right = between(i + 1);
            row[i] = left + part.x * (right - left);
            left = right;
        }
    }
    return result;
}

}  // namespace

Layer offset(const FilterStep& step) {
    const glm::dvec2 by = glm::dvec2(step.parameters[0], step.parameters[1]) * step.scale;
    const glm::dvec2 whole = glm::round(by);
    if (!(std::abs(by.x) < 1e8 && std::abs(by.y) < 1e8))
        return Layer(step.box, step.linear);
    const Layer& input = *step.inputs[0];
    constexpr double sameplace = 1.0 / 1024;  // of a pixel: less shows in no 8-bit colour
    if (step.inWholePixels ||
        (std::abs(by.x - whole.x) < sameplace && std::abs(by.y - whole.y) < sameplace)) {
        const glm::ivec2 shift(whole);
        const PixelBox moved = input.box.moved(shift).intersection(step.box);
        Layer result = cropped(input, moved.moved(-shift));
        result.box = moved;
        return result;
    }
    return betweenPixels(input, -by, input.box.moved(glm::ivec2(whole)).grown(glm::ivec2(1)), step);
}

Layer displace(const FilterStep& step) {
    const FilterParameters& p = step.parameters;
    const float byX = float(p[0] * step.scale.x), byY = float(p[0] * step.scale.y);
    const int channelX = int(p[1]), channelY = int(p[2]);
    const Layer& input = *step.inputs[0];
    const Layer& map = *step.inputs[1];
    Layer result = madeOf(step, step.box, [&](int x, int y) {
        const Float4 moved = straightened(map.at(x, y));
        return bilinear(input, float(x) + 0.5f + byX * (moved[channelX] - 0.5f),
                        float(y) + 0.5f + byY * (moved[channelY] - 0.5f));
    });
    result.linear = input.linear;
    return result;
}

Layer tile(const FilterStep& step) {
    const PixelRect& region = step.regions[0];
    const glm::dvec2 size = region.max - region.min;
    const Layer& input = *step.inputs[0];
    constexpr double least = 1.0 / 64;  // of a pixel: below, a tile shows nothing
    if (!(size.x >= least && size.y >= least))
        return Layer(step.box, step.linear);
    const auto wrapped = [](double v, double min, double length) {
        return min + (v - min) - length * std::floor((v - min) / length);
    };
    const auto read = [&](double x, double y) {
        return input.at(int(std::floor(wrapped(x, region.min.x, size.x))),
                        int(std::floor(wrapped(y, region.min.y, size.y))));
    };
    return madeOf(step, step.box, [&](int x, int y) { return read(x + 0.5, y + 0.5); });
}

}  // namespace vtm::asset

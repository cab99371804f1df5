#include "raster/src/image_fill.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "raster/src/gradient.hpp"

namespace vtm::asset {

namespace {

using glm::mat2;
using glm::vec2;
using glm::vec4;

/// Texels of one level, beyond whose border the border's go on.
struct Texels {
    int width, height;
    const std::uint8_t* rgba;
    bool premultiplied;

    vec4 at(int x, int y) const {
        x = std::clamp(x, 0, width - 1);
        y = std::clamp(y, 0, height - 1);
        const std::uint8_t* p = rgba + (std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4;
        const vec4 c = vec4(p[0], p[1], p[2], p[3]) / 255.0f;
        return premultiplied ? c : vec4(glm::vec3(c) * c.a, c.a);
    }
};

/// How texels make a colour: the mean of a square, `width` texels wide, and by a share Catmull-Rom's cubic.
struct Kernel {
    float width;  ///< in [1, 4]; at 1 the mean interpolates
    float cubic = 0;

    /// Of texels in a row that count at most, the one at floor(p - reach) first.
    int taps() const { return cubic > 0 ? 4 : int(std::ceil(width)) + 1; }
    float reach() const { return cubic > 0 ? 1.5f : 0.5f * width; }

    /// Weight of a texel whose middle is at distance d along one axis. The cubic (Keys 1981, a = -1/2) passes
    /// through the pixels, and through the points of any quadratic.
    float operator()(float d) const {
        if (width == 0)
            return 1;
        d = std::abs(d);
        const float mean =
            std::max(std::min(d + 0.5f, 0.5f * width) - std::max(d - 0.5f, -0.5f * width), 0.0f) / width;
        if (cubic == 0)
            return mean;
        const float keys = d < 1 ? (1.5f * d - 2.5f) * d * d + 1 : ((-0.5f * d + 2.5f) * d - 4) * d + 2;
        return glm::mix(mean, keys, cubic);
    }
};
constexpr Kernel nearest{0};

/// Premultiplied neighbours are summed, so that transparent pixels lend no colour.
vec4 filtered(const Texels& texels, vec2 place, const Kernel& kernel) {
    // Keeps the conversion to int defined, for what is not a number too; beyond the border the edge goes on
    // anyway.
    const vec2 p(std::fmax(-2.0f, std::fmin(place.x, float(texels.width) + 2)),
                 std::fmax(-2.0f, std::fmin(place.y, float(texels.height) + 2)));
    const vec2 corner = glm::floor(p - kernel.reach());
    const int taps = kernel.taps();
    vec4 sum(0);
    for (int j = 0; j < taps; ++j)
        for (int i = 0; i < taps; ++i) {
            const vec2 d = corner + vec2(i, j) + 0.5f - p;
            sum += kernel(d.x) * kernel(d.y) * texels.at(int(corner.x) + i, int(corner.y) + j);
        }
    return sum;
}

/// Where a pixel's footprint is read (docs/scene.md, filters of images): at 2 side + 1 points along its
/// longer axis, a step apart, each for a square `width` wide. The outermost two count `outer`, and all of
/// them `all`.
struct Probes {
    int side;
    float width, outer, all;
    vec2 step;
};

constexpr float maxOblong = 16, nearlyRound = 1.0f / 64;

/// `m`: a pixel's sides in the image. Its singular values are the axes of the ellipse that it makes of a
/// circle.
Probes probesOf(const mat2& m) {
    const float a = m[0].x * m[0].x + m[1].x * m[1].x, b = m[0].x * m[0].y + m[1].x * m[1].y,
                c = m[0].y * m[0].y + m[1].y * m[1].y;
    const float half = 0.5f * (a - c), root = glm::length(vec2(half, b));
    const float longer = std::sqrt(0.5f * (a + c) + root), shorter = std::abs(glm::determinant(m)) / longer;
    const vec2 along = half > 0 ? vec2(half + root, b) : vec2(b, root - half);
    // fmax and fmin: what is no number gives way to the other.
    const float width = std::fmax(1.0f, std::fmax(shorter, longer / maxOblong));
    const float all = std::fmax(1.0f, std::fmin(longer / width - nearlyRound, maxOblong));
    const int side = int(std::ceil(0.5f * (all - 1)));
    return {side, width, side == 0 ? 1 : 0.5f * (all - float(2 * side - 1)), all,
            side == 0 ? vec2(0) : along * (width / glm::length(along))};
}

/// Catmull-Rom overshoots beside edges.
vec4 asColor(vec4 c) {
    const float a = glm::clamp(c.a, 0.0f, 1.0f);
    return {glm::clamp(glm::vec3(c), 0.0f, a), a};
}

/// Of squares two to four texels wide; those of the picture itself may be narrower.
constexpr float mostTexels = 4;
/// From so many texels on a level is blended with the next, so that none comes at once.
constexpr float blendsFrom = 3.5f;
/// From one texel to so many the cubic becomes the mean of a square.
constexpr float cubicTo = 1.25f;

}  // namespace

Images::Images(const AssetView& asset) {
    const std::vector<bool> wanted = imagesWithLevels(asset);
    for (std::size_t i = 0; i < asset.images.size(); ++i)
        pictures_.push_back(
            {&asset.images[i], wanted[i] ? image::levelsOf(asset.images[i]) : std::vector<image::Level>()});
}

vec4 Images::color(const ImageFill& fill, vec2 point, const mat2& pixel) const {
    const LeveledImage& picture = pictures_[fill.image];
    const vec2 p = applyMatrix(fill.matrix, point);
    const auto read = [&](std::size_t l, vec2 place, const Kernel& kernel) {
        if (l == 0)
            return filtered(
                {picture.bitmap->width, picture.bitmap->height, picture.bitmap->rgba.data(), false}, place,
                kernel);
        const image::Level& texels = picture.levels[l - 1];
        return filtered({texels.width, texels.height, texels.rgba.data(), true},
                        std::ldexp(1.0f, -int(l)) * place, kernel);
    };
    if (fill.filter < ImageFilter::Trilinear)
        return read(0, p, fill.filter == ImageFilter::Nearest ? nearest : Kernel{1});
    const mat2 linear(fill.matrix[0], fill.matrix[1], fill.matrix[2], fill.matrix[3]);
    const Probes probes = probesOf(linear * pixel);
    const float last = float(picture.levels.size());
    const float lod = std::clamp(std::floor(std::log2(probes.width)) - 1, 0.0f, last);
    const auto finer = std::size_t(lod);
    Kernel kernel{glm::clamp(std::ldexp(probes.width, -int(finer)), 1.0f, mostTexels)};
    if (finer == 0 && fill.filter == ImageFilter::Bicubic)
        kernel.cubic = std::max((cubicTo - kernel.width) / (cubicTo - 1), 0.0f);
    const float share =
        lod == last ? 0 : std::max((kernel.width - blendsFrom) / (mostTexels - blendsFrom), 0.0f);
    vec4 sum(0);
    for (int i = -probes.side; i <= probes.side; ++i) {
        const vec2 place = p + float(i) * probes.step;
        vec4 color = read(finer, place, kernel);
        if (share > 0)
            color = glm::mix(color, read(finer + 1, place, Kernel{0.5f * kernel.width}), share);
        sum += (std::abs(i) == probes.side ? probes.outer : 1) / probes.all * color;
    }
    return asColor(sum);
}

}  // namespace vtm::asset

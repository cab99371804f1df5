#include "raster/src/image_fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "raster/src/gradient.hpp"

namespace vtm::asset {

namespace {

using glm::mat2;
using glm::vec2;

/// Of texels in a row that count at most, the one at floor(p - reach) first.
int tapsOf(const TexelKernel& kernel) { return kernel.cubic > 0 ? 4 : int(std::ceil(kernel.width)) + 1; }
float reachOf(const TexelKernel& kernel) { return kernel.cubic > 0 ? 1.5f : 0.5f * kernel.width; }

Float4 least(Float4 a, Float4 b) { return a < b ? a : b; }
Float4 most(Float4 a, Float4 b) { return a > b ? a : b; }
Float4 all(float value) { return Float4{value, value, value, value}; }

/// Weights of texels whose middles are at distances d along one axis. The cubic (Keys 1981, a = -1/2) passes
/// through the pixels, and through the points of any quadratic.
Float4 weightsOf(const TexelKernel& kernel, Float4 d) {
    if (kernel.width == 0)
        return all(1);
    d = most(d, -d);
    const Float4 half = all(0.5f * kernel.width);
    const Float4 mean = most(least(d + 0.5f, half) - most(d - 0.5f, -half), Float4{}) / kernel.width;
    if (kernel.cubic == 0)
        return mean;
    const Float4 keys = d < all(1) ? (1.5f * d - 2.5f) * d * d + 1 : ((-0.5f * d + 2.5f) * d - 4) * d + 2;
    return (1 - kernel.cubic) * mean + kernel.cubic * keys;
}

/// std::floor() of what an int holds; that is a function call without SSE 4.1.
int floorOf(float value) {
    const int truncated = int(value);
    return truncated - (float(truncated) > value);
}

/// A place along one axis of so many texels. Keeps the conversion to int defined; beyond the border the edge
/// goes on anyway. What is no number becomes -2.
float bounded(float place, int size) { return place > -2 ? std::min(place, float(size) + 2) : -2.0f; }

constexpr float perByte = 1.0f / 255;

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
Float4 asColor(Float4 c) {
    const float a = std::clamp(c[3], 0.0f, 1.0f);
    const Float4 zero{}, most{a, a, a, a};
    c = c > zero ? c : zero;
    c = c < most ? c : most;
    c[3] = a;
    return c;
}

/// Of squares two to four texels wide; those of the picture itself may be narrower.
constexpr float mostTexels = 4;
/// From so many texels on a level is blended with the next, so that none comes at once.
constexpr float blendsFrom = 3.5f;
/// From one texel to so many the cubic becomes the mean of a square.
constexpr float cubicTo = 1.25f;

bool allOpaque(const image::Bitmap& bitmap) {
    for (std::size_t i = 3; i < bitmap.rgba.size(); i += 4)
        if (bitmap.rgba[i] != 255)
            return false;
    return true;
}

}  // namespace

inline Taps::Taps(float place, int size, const TexelKernel& kernel) {
    const float p = bounded(place, size);
    first = floorOf(p - reachOf(kernel));
    count = tapsOf(kernel);
    const Float4 distances = (float(first) + 0.5f - p) + Float4{0, 1, 2, 3};
    weights[0] = weightsOf(kernel, distances);
    if (count > 4)
        weights[1] = weightsOf(kernel, distances + 4.0f);
}

LeveledImage::LeveledImage(const image::Bitmap& bitmap) : bitmap_(bitmap), made_(std::make_shared<Made>()) {
    made_->isOpaque = allOpaque(bitmap);
}

const image::Level& LeveledImage::level(unsigned number) const {
    std::call_once(made_->areLevelsMade, [&] { made_->levels = image::levelsOf(bitmap_); });
    return made_->levels[number - 1];
}

Images::Images(const AssetView& asset) {
    for (const image::Bitmap& bitmap : asset.images)
        images_.emplace_back(bitmap);
}

Images::Images(const AssetView& asset, const Images& last) {
    for (std::size_t i = 0; i < asset.images.size(); ++i)
        images_.emplace_back(asset.images[i], last.images_[i]);
}

ImageReader::ImageReader(const Images& images, const ImageFill& fill, const mat2& pixel)
    : matrix_(fill.matrix) {
    const LeveledImage& image = images[fill.image];
    texels_ = texelsOf(image, 0);
    if (fill.filter < ImageFilter::Trilinear) {
        kernel_.width = fill.filter == ImageFilter::Nearest ? 0 : 1;
        finer_.prepare(texels_, kernel_);
        return;
    }
    probes_ = probesOf(mat2(fill.matrix[0], fill.matrix[1], fill.matrix[2], fill.matrix[3]) * pixel);
    const auto last = float(image.levelCount());
    const float lod = std::clamp(std::floor(std::log2(probes_.width)) - 1, 0.0f, last);
    const auto level = unsigned(lod);
    texels_ = texelsOf(image, level);
    kernel_.width = glm::clamp(probes_.width * texels_.scale, 1.0f, mostTexels);
    if (level == 0 && fill.filter == ImageFilter::Bicubic)
        kernel_.cubic = std::max((cubicTo - kernel_.width) / (cubicTo - 1), 0.0f);
    finer_.prepare(texels_, kernel_);
    if (lod != last && kernel_.width > blendsFrom) {
        share_ = (kernel_.width - blendsFrom) / (mostTexels - blendsFrom);
        coarser_.prepare(texelsOf(image, level + 1), {0.5f * kernel_.width});
    }
}

Texels ImageReader::texelsOf(const LeveledImage& image, unsigned level) {
    if (level == 0)
        return {image.bitmap().width, image.bitmap().height, image.bitmap().rgba.data(), image.isOpaque(), 1};
    const image::Level& texels = image.level(level);
    return {texels.width, texels.height, texels.rgba.data(), true, std::ldexp(1.0f, -int(level))};
}

inline Float4 Texels::operator()(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    const Float4 c = float4(rgba + (std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4);
    const float alpha = premultiplied ? 1 : c[3] * (1.0f / 255);
    return c * Float4{alpha, alpha, alpha, 1};
}

void ImageReader::knowColumns(int x, int y, float below) {
    const auto column = [&](int at) { return (1 - below) * texels_(at, y) + below * texels_(at, y + 1); };
    const bool sameRows = columns_.y == y && columns_.below == below;
    if (!sameRows || columns_.x != x) {
        const bool next = sameRows && columns_.x == x - 1;
        columns_ = {x, y, below, next ? columns_.right : column(x), column(x + 1)};
    }
}

/// Between four texels. Premultiplied neighbours are summed, so that transparent pixels lend no colour.
Float4 ImageReader::interpolated(vec2 place) {
    const float px = bounded(place.x, texels_.width) - 0.5f, py = bounded(place.y, texels_.height) - 0.5f;
    const int x = floorOf(px), y = floorOf(py);
    knowColumns(x, y, py - float(y));
    return columns_.left + (px - float(x)) * (columns_.right - columns_.left);
}

/// At places along a row of texels. Between two columns colours are straight.
void ImageReader::interpolateRow(vec2 place, float change, std::span<Float4> colors) {
    const float py = bounded(place.y, texels_.height) - 0.5f;
    const int y = floorOf(py);
    const auto placeOf = [&](std::size_t i) { return place.x + float(int(i)) * change; };
    for (std::size_t i = 0; i < colors.size();) {
        const float px = bounded(placeOf(i), texels_.width) - 0.5f;
        const int x = floorOf(px);
        knowColumns(x, y, py - float(y));
        const Float4 left = perByte * columns_.left, slope = perByte * (columns_.right - columns_.left);
        const float start = float(x) + 0.5f;
        float right = px - float(x);
        do {
            colors[i++] = left + right * slope;
            right = placeOf(i) - start;
        } while (i < colors.size() && right >= 0 && right < 1);
    }
}

inline Float4 KernelSums::column(int x) const {
    Float4 sum{};
    for (int j = 0; j < down_.count; ++j)
        sum += down_.weight(j) * texels_(x, down_.first + j);
    return sum;
}

Float4 KernelSums::at(vec2 place) {
    const Taps across(place.x, texels_.width, kernel_);
    Float4 sum{};
    if (place.y != y_) {
        y_ = place.y;
        down_ = Taps(place.y, texels_.height, kernel_);
        numbers_.fill(none);
        for (int i = 0; i < across.count; ++i)
            sum += across.weight(i) * column(across.first + i);
        return sum;
    }
    for (int i = 0; i < across.count; ++i) {
        const int x = across.first + i;
        const auto slot = std::size_t(x & (kept - 1));
        if (numbers_[slot] != x) {
            numbers_[slot] = x;
            columns_[slot] = column(x);
        }
        sum += across.weight(i) * columns_[slot];
    }
    return sum;
}

void ImageReader::colors(vec2 first, vec2 step, std::span<Float4> colors) {
    const vec2 change = mat2(matrix_[0], matrix_[1], matrix_[2], matrix_[3]) * step;
    if (interpolates() && change.y == 0)
        return interpolateRow(texels_.scale * applyMatrix(matrix_, first), texels_.scale * change.x, colors);
    for (std::size_t i = 0; i < colors.size(); ++i)
        colors[i] = color(first + float(int(i)) * step);
}

Float4 ImageReader::color(vec2 point) {
    const vec2 p = texels_.scale * applyMatrix(matrix_, point);
    if (interpolates())
        return perByte * interpolated(p);
    Float4 sum{};
    for (int i = -probes_.side; i <= probes_.side; ++i) {
        const vec2 place = p + float(i) * texels_.scale * probes_.step;
        Float4 color = finer_.at(place);
        if (share_ > 0)
            color = (1 - share_) * color + share_ * coarser_.at(0.5f * place);
        sum += (std::abs(i) == probes_.side ? probes_.outer : 1) / probes_.all * perByte * color;
    }
    return asColor(sum);
}

}  // namespace vtm::asset

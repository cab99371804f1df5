/// \file
/// Images of paint programs; twin of backend_gl/shaders/shared/image.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include "image/levels.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// An image with its levels.
class LeveledImage {
public:
    /// The bitmap must outlive it.
    explicit LeveledImage(const image::Bitmap& bitmap);
    /// Of a copy of the bitmap of `last`, which may be gone.
    LeveledImage(const image::Bitmap& bitmap, const LeveledImage& last)
        : bitmap_(bitmap), made_(last.made_) {}

    const image::Bitmap& bitmap() const { return bitmap_; }
    bool isOpaque() const { return made_->isOpaque; }
    unsigned levelCount() const { return image::levelCount(bitmap_); }
    /// From level 1 on. All are made when the first one is asked for, by any thread: few views need them.
    const image::Level& level(unsigned number) const;

private:
    struct Made {
        bool isOpaque = false;
        std::once_flag areLevelsMade;
        std::vector<image::Level> levels;
    };

    const image::Bitmap& bitmap_;
    std::shared_ptr<Made> made_;
};

/// An asset's images. The asset must outlive it.
class Images {
public:
    explicit Images(const AssetView& asset);
    /// Of an asset with the same images as that of `last`, which may be gone.
    Images(const AssetView& asset, const Images& last);

    const LeveledImage& operator[](std::uint32_t i) const { return images_[i]; }

private:
    std::deque<LeveledImage> images_;
};

/// How texels make a colour: the mean of a square, `width` texels wide, and by a share Catmull-Rom's cubic.
struct TexelKernel {
    float width = 1;  ///< 0: of the nearest; else in [1, 4]; at 1 the mean interpolates
    float cubic = 0;
};

/// Along one axis: the first texel, and what it and those after it count.
struct Taps {
    static constexpr int most = 5;

    int first = 0, count = 0;
    std::array<Float4, 2> weights;  ///< four by four

    Taps() = default;
    /// Around a place on an axis of `size` texels.
    Taps(float place, int size, const TexelKernel& kernel);

    float weight(int i) const { return weights[std::size_t(i / 4)][i % 4]; }
};

/// Texels of one level, beyond whose border the border's go on.
struct Texels {
    int width = 0, height = 0;
    const std::uint8_t* rgba = nullptr;
    bool premultiplied = false;
    float scale = 1;  ///< from the image's pixels

    /// Premultiplied, 0 to 255.
    Float4 operator()(int x, int y) const;
};

/// Sums of texels under a kernel. Columns are kept: places along a row of texels share most of them.
class KernelSums {
public:
    void prepare(const Texels& texels, const TexelKernel& kernel) {
        texels_ = texels;
        kernel_ = kernel;
    }
    /// 0 to 255.
    Float4 at(glm::vec2 place);

private:
    static constexpr int kept = 8, none = std::numeric_limits<int>::min();  // kept: a power of two
    static_assert(kept >= Taps::most);

    Float4 column(int x) const;

    Texels texels_;
    TexelKernel kernel_;
    float y_ = std::numeric_limits<float>::quiet_NaN();  ///< of the kept columns
    Taps down_;
    std::array<int, kept> numbers_;  ///< of the kept columns, each at its number modulo `kept`
    std::array<Float4, kept> columns_;
};

/// Where a pixel's footprint is read (docs/scene.md, filters of images): at 2 side + 1 points along its
/// longer axis, a step apart, each for a square `width` wide. The outermost two count `outer`, and all of
/// them `all`.
struct Probes {
    int side = 0;
    float width = 1, outer = 1, all = 1;
    glm::vec2 step{0};
};

/// Reads an image for pixels of one size: what depends on the size is found once.
class ImageReader {
public:
    /// `pixel`: what a step of a pixel in x and in y is in the picture. The images must outlive it.
    ImageReader(const Images& images, const ImageFill& fill, const glm::mat2& pixel);

    /// Premultiplied, at a point of the picture. Places one after the other along a row of texels are read
    /// fast.
    Float4 color(glm::vec2 point);
    /// The same at points that are `step` apart, of which `first` is the first.
    void colors(glm::vec2 first, glm::vec2 step, std::span<Float4> colors);

private:
    static Texels texelsOf(const LeveledImage& image, unsigned level);
    bool interpolates() const { return kernel_.width == 1 && kernel_.cubic == 0 && probes_.side == 0; }
    Float4 interpolated(glm::vec2 place);
    void interpolateRow(glm::vec2 place, float change, std::span<Float4> colors);
    void knowColumns(int x, int y, float below);

    std::array<float, 6> matrix_;
    Probes probes_;
    TexelKernel kernel_;
    float share_ = 0;  ///< of the coarser level
    Texels texels_;
    KernelSums finer_, coarser_;

    /// Of texels in two columns, between two rows of them.
    struct {
        int x = std::numeric_limits<int>::min(), y = 0;
        float below = 0;
        Float4 left{}, right{};
    } columns_;
};

}  // namespace vtm::asset

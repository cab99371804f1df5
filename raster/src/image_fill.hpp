/// \file
/// Images of paint programs; twin of backend_gl/shaders/shared/image.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include "image/levels.hpp"
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// An image with those of its levels that a paint reads.
struct LeveledImage {
    const image::Bitmap* bitmap;
    std::shared_ptr<const std::vector<image::Level>> levels;  ///< null: no paint reads them
    bool isOpaque;

    std::size_t levelCount() const { return levels ? levels->size() : 0; }
};

/// An asset's images. The asset must outlive it.
class Images {
public:
    explicit Images(const AssetView& asset);
    /// Of an asset with the same images as that of `last`, which may be gone.
    Images(const AssetView& asset, const Images& last);

    const LeveledImage& operator[](std::uint32_t i) const { return images_[i]; }

private:
    void makeLevels(const AssetView& asset);

    std::vector<LeveledImage> images_;
};

/// How texels make a colour: the mean of a square, `width` texels wide, and by a share Catmull-Rom's cubic.
struct TexelKernel {
    float width = 1;  ///< 0: of the nearest; else in [1, 4]; at 1 the mean interpolates
    float cubic = 0;
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

private:
    /// Texels of one level, beyond whose border the border's go on.
    struct Texels {
        int width = 0, height = 0;
        const std::uint8_t* rgba = nullptr;
        bool premultiplied = false;
        float scale = 1;  ///< from the image's pixels

        /// Premultiplied, 0 to 255.
        Float4 operator()(int x, int y) const;
    };

    static Texels texelsOf(const LeveledImage& image, unsigned level);
    Float4 interpolated(const Texels& texels, glm::vec2 place);
    static Float4 summed(const Texels& texels, glm::vec2 place, const TexelKernel& kernel);

    std::array<float, 6> matrix_;
    Probes probes_;
    TexelKernel kernel_;
    float share_ = 0;  ///< of the coarser level
    Texels finer_, coarser_;

    /// Of texels in two columns, between two rows of them.
    struct {
        int x = std::numeric_limits<int>::min(), y = 0;
        float below = 0;
        Float4 left{}, right{};
    } columns_;
};

}  // namespace vtm::asset

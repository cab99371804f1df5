/// \file
/// What handles stand for (specification section 3.6). Objects live while something refers to them, a handle
/// or another object.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <unordered_map>
#include <vector>

#include <glm/vec2.hpp>

#include <VG/openvg.h>

#include "api/openvg/draw/path_masks.hpp"
#include "api/openvg/image/stored_pixels.hpp"
#include "api/openvg/path/path_data.hpp"

namespace vtm::openvg {

struct Object {
    VGHandle handle = VG_INVALID_HANDLE;  ///< set by Handles::add; VG_INVALID_HANDLE again once destroyed

    virtual ~Object() = default;
};

// ---- Section 8 ------------------------------------------------------------------------------------

struct Path : Object {
    PathData data;
    VGbitfield capabilities = 0;
    PathMasks masks;  ///< how `data` is filled and stroked, made when first needed
};

// ---- Section 10 -----------------------------------------------------------------------------------

struct SharedPixels;

/// The pixels that related images share, and who uses them. Contexts that share no objects may share pixels.
struct ImageStorage {
    explicit ImageStorage(Pixels p) : pixels(std::move(p)) {}

    StoredPixels pixels;
    std::atomic<int> images = 0;               ///< that show a part of it
    std::atomic<int> uses = 0;                 ///< as patterns and glyphs
    std::atomic<bool> isTarget = false;        ///< drawn into
    std::weak_ptr<const SharedPixels> shared;  ///< of EGLImage siblings
};

struct Image : Object {
    std::shared_ptr<ImageStorage> storage;
    Rectangle area;  ///< of the storage
    VGint formatName = 0;
    VGbitfield allowedQuality = 0;
    std::shared_ptr<Image> parent;
    std::shared_ptr<const SharedPixels> siblings;  ///< of an EGLImage target

    Image(std::shared_ptr<ImageStorage> s, Rectangle a) : storage(std::move(s)), area(a) {
        ++storage->images;
    }
    ~Image() override { --storage->images; }

    int width() const { return area.x1 - area.x0; }
    int height() const { return area.y1 - area.y0; }
    const PixelFormat& format() const { return storage->pixels.format(); }
    /// To be changed, or to be read.
    std::uint8_t* at(int x, int y) { return storage->pixels.write().at(area.x0 + x, area.y0 + y); }
    const std::uint8_t* at(int x, int y) const { return storage->pixels.read().at(area.x0 + x, area.y0 + y); }
    std::ptrdiff_t stride() const { return storage->pixels.stride(); }
    Color color(int x, int y) const {
        return format().decode(storage->pixels.read().word(area.x0 + x, area.y0 + y));
    }
};

/// An image as another object's pattern or glyph: it may not be drawn into meanwhile (section 4).
class UsedImage {
public:
    UsedImage() = default;
    explicit UsedImage(std::shared_ptr<Image> image) : image_(std::move(image)) {
        if (image_)
            ++image_->storage->uses;
    }
    ~UsedImage() {
        if (image_)
            --image_->storage->uses;
    }
    UsedImage(UsedImage&& other) noexcept : image_(std::move(other.image_)) { other.image_ = nullptr; }
    UsedImage& operator=(UsedImage&& other) noexcept {
        std::swap(image_, other.image_);
        return *this;
    }

    explicit operator bool() const { return image_ != nullptr; }
    const Image& operator*() const { return *image_; }
    const Image* operator->() const { return image_.get(); }

private:
    std::shared_ptr<Image> image_;
};

// ---- Section 9 ------------------------------------------------------------------------------------

/// Values as they were set; ranges are applied where they are used.
struct Paint : Object {
    VGPaintType type = VG_PAINT_TYPE_COLOR;
    std::array<VGfloat, 4> color{0, 0, 0, 1};
    VGColorRampSpreadMode spread = VG_COLOR_RAMP_SPREAD_PAD;
    bool rampPremultiplied = true;
    std::vector<VGfloat> stops;  ///< five numbers each: offset, red, green, blue, alpha
    std::array<VGfloat, 4> linear{0, 0, 1, 0};
    std::array<VGfloat, 5> radial{0, 0, 0, 0, 1};
    VGTilingMode tiling = VG_TILE_FILL;
    UsedImage pattern;

    // VG_NDS_paint_generation; the matrix in columns of four, the last what is added.
    bool rampLinear = false, transformLinear = false;
    static constexpr std::array<VGfloat, 20> identityMatrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::array<VGfloat, 20> colorMatrix = identityMatrix;
};

// ---- Section 7.2 ----------------------------------------------------------------------------------

namespace gl {
class Texture;
}

/// Coverage in bytes, 255 being 1; row 0 at the bottom.
struct MaskValues {
    int width = 0, height = 0;
    /// The same on a GPU; null: there is none, or it is out of date.
    mutable std::shared_ptr<const gl::Texture> texture;

    MaskValues() = default;
    MaskValues(int w, int h) : width(w), height(h), values_(std::size_t(w) * std::size_t(h), 255) {}
    /// To be changed, or to be read.
    std::uint8_t* row(int y) {
        texture = nullptr;
        return values_.data() + std::size_t(y) * std::size_t(width);
    }
    const std::uint8_t* row(int y) const { return values_.data() + std::size_t(y) * std::size_t(width); }
    const std::vector<std::uint8_t>& values() const { return values_; }
    void fill(std::uint8_t value) {
        texture = nullptr;
        std::ranges::fill(values_, value);
    }

private:
    std::vector<std::uint8_t> values_;
};

struct MaskLayer : Object {
    MaskValues mask;
};

// ---- Section 11 -----------------------------------------------------------------------------------

struct Glyph {
    std::shared_ptr<Path> path;  ///< at most one of the two; none: nothing to see
    UsedImage image;
    glm::vec2 origin{0}, escapement{0};
};

struct Font : Object {
    std::unordered_map<VGuint, Glyph> glyphs;
};

}  // namespace vtm::openvg

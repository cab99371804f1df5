#include "api/openvg/draw/texel_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "api/openvg/draw/source_description.hpp"
#include "api/openvg/draw/texel_rows.hpp"
#include "api/openvg/image/pixel_rows.hpp"

namespace vtm::openvg {

// ---- Texels ---------------------------------------------------------------------------------------

Texels::Texels(const Image& image, VGTilingMode tiling, const std::array<VGfloat, 4>& fillColor)
    : image_(image), tiling_(tiling), fill_(givenColor(fillColor, space())) {}

ColorSpace Texels::space() const {
    const ColorSpace own = image_.format().space;
    return {own.linear, true, own.luminance};
}

Color Texels::at(double x, double y) const {
    const int i = column(x), j = row(y);
    if (i < 0 || j < 0)
        return fill_;
    const Color color = image_.color(i, j);
    return image_.format().space.premultiplied ? color : premultiplied(color);
}

int Texels::inside(double v, int size) const {
    if (v >= 0 && v < size)
        return int(v);
    if (tiling_ == VG_TILE_FILL)
        return -1;
    if (!(std::abs(v) < 1e15))
        return 0;
    const double tile = std::floor(v / size);
    const int i = int(v - size * tile);
    if (tiling_ == VG_TILE_REPEAT)
        return i;
    if (tiling_ == VG_TILE_REFLECT)
        return std::fmod(tile, 2) != 0 ? size - 1 - i : i;
    return v < 0 ? 0 : size - 1;
}

// ---- The source -----------------------------------------------------------------------------------

int samplesAlong(glm::dvec2 side) {
    const double length = glm::length(side);
    // A little longer is not longer.
    return length > 1.001 ? int(std::min(std::ceil(length), double(maxSamples))) : 1;
}

namespace {

using glm::dvec2;

/// Whether pixels are texels: the map moves by whole pixels, and may turn rows upside down.
bool isMove(const glm::dmat3& m) {
    constexpr double limit = 1 << 30;
    const auto isWhole = [](double v) { return std::abs(v) < limit && v == std::floor(v); };
    return m[0] == glm::dvec3(1, 0, 0) && (m[1] == glm::dvec3(0, 1, 0) || m[1] == glm::dvec3(0, -1, 0)) &&
           m[2].z == 1 && isWhole(m[2].x) && isWhole(m[2].y);
}

class TexelSource final : public PixelSource {
public:
    TexelSource(const Texels& texels, const glm::dmat3& fromSurface, bool isSmooth)
        : PixelSource(texels.space()),
          texels_(texels),
          rows_(texels_),
          fromSurface_(fromSurface),
          isSmooth_(isSmooth),
          isAffine_(fromSurface[0].z == 0 && fromSurface[1].z == 0),
          isMove_(isMove(fromSurface)),
          right_(dvec2(fromSurface[0]) / fromSurface[2].z),
          up_(dvec2(fromSurface[1]) / fromSurface[2].z) {}

    void colors(int x, int y, std::span<Color> colors) const override {
        if (isMove_)
            return movedRow(x, y, colors);
        inChunks(int(colors.size()), [&](int first, int count) {
            const std::span<Color> part = colors.subspan(std::size_t(first), std::size_t(count));
            if (isAffine_ && isNear(x + first, y) && isNear(x + first + count, y))
                return affineRow(x + first, y, part);
            for (int i = 0; i < count; ++i)
                part[std::size_t(i)] = color(double(x) + first + i + 0.5, y + 0.5);
        });
    }

    const PixelFormat* storedFormat() const override {
        const bool isNearest = isAffine_ && !isSmooth_ && texels_.tiling() != VG_TILE_FILL;
        return isMove_ || isNearest ? &texels_.image().format() : nullptr;
    }

    std::optional<StoredRow> stored(int x, int y, int count) const override {
        const Image& image = texels_.image();
        if (isMove_) {
            const dvec2 p = mapped(x + 0.5, y + 0.5);
            if (!(p.x >= 0 && p.y >= 0 && p.x + count - 1 < image.width() && p.y < image.height()))
                return std::nullopt;
            return StoredRow{image.at(int(p.x), int(p.y))};
        }
        if (!isNear(x, y) || !isNear(x + count, y))
            return std::nullopt;
        nearest_.resize(std::size_t(count) * image.format().pixelBytes());
        rows_.nearestStored(fromSurface_, {x + 0.5, y + 0.5}, count, nearest_.data());
        return StoredRow{nearest_.data()};
    }

    bool describe(SourceDescription& d) const override {
        d.colors = TexelField{fromSurface_, &texels_.image(), texels_.tiling(), texels_.fill(),
                              isSmooth_ && !isMove_};
        d.colorSpace = d.space = space();
        return true;
    }

private:
    dvec2 mapped(double x, double y) const {
        const glm::dvec3 p = fromSurface_ * glm::dvec3(x, y, 1);
        return dvec2(p) / p.z;
    }

    /// Whether a pixel's place fits into an int, with its samples.
    bool isNear(double x, double y) const {
        constexpr double limit = 1e9;
        const dvec2 p = glm::abs(mapped(x, y)) + glm::abs(right_) + glm::abs(up_);
        return p.x < limit && p.y < limit;
    }

    void movedRow(int x, int y, std::span<Color> colors) const {
        const Image& image = texels_.image();
        const dvec2 p = glm::floor(mapped(x + 0.5, y + 0.5));
        const int row = texels_.row(p.y);
        for (int i = 0, count = int(colors.size()); i < count;) {
            const int column = texels_.column(p.x + i);
            const bool isStored = row >= 0 && p.x + i >= 0 && p.x + i < image.width();
            const int run = isStored ? std::min(count - i, image.width() - column) : 1;
            const std::span<Color> part = colors.subspan(std::size_t(i), std::size_t(run));
            if (isStored) {
                decodeRow(image.format(), image.at(column, row), part);
                convertColors(part, image.format().space, space());
            } else {
                part[0] = texels_.at(p.x + i, p.y);
            }
            i += run;
        }
    }

    void affineRow(int x, int y, std::span<Color> colors) const {
        if (!isSmooth_)
            return rows_.nearest(fromSurface_, {x + 0.5, y + 0.5}, colors);
        const dvec2 first = mapped(x + 0.5, y + 0.5);
        const int across = samplesAlong(right_), along = samplesAlong(up_);
        if (across == 1 && along == 1)
            return rows_.bilinear(first, right_, colors);
        std::ranges::fill(colors, Color(0));
        std::array<Color, rowChunk> buffer;
        const std::span<Color> samples = std::span(buffer).first(colors.size());
        for (int j = 0; j < along; ++j)
            for (int i = 0; i < across; ++i) {
                rows_.bilinear(first + ((i + 0.5) / across - 0.5) * right_ + ((j + 0.5) / along - 0.5) * up_,
                               right_, samples);
                for (std::size_t k = 0; k < colors.size(); ++k)
                    colors[k] += samples[k];
            }
        for (Color& color : colors)
            color *= 1 / float(across * along);
    }

    // ---- Under any map, pixel by pixel ----

    Color color(double x, double y) const {
        const dvec2 p = mapped(x, y);
        if (!isSmooth_)
            return texels_.at(std::floor(p.x), std::floor(p.y));
        const int across = samplesAlong(mapped(x + 0.5, y) - mapped(x - 0.5, y)),
                  up = samplesAlong(mapped(x, y + 0.5) - mapped(x, y - 0.5));
        if (across == 1 && up == 1)
            return bilinear(p);
        Color sum(0);
        for (int j = 0; j < up; ++j)
            for (int i = 0; i < across; ++i)
                sum += bilinear(mapped(x - 0.5 + (i + 0.5) / across, y - 0.5 + (j + 0.5) / up));
        return sum / float(across * up);
    }

    Color bilinear(dvec2 p) const {
        const dvec2 q = p - 0.5, floor = glm::floor(q), f = q - floor;
        // So far away that there are no places between texels, or nowhere.
        if (f == dvec2(0) || !(std::isfinite(f.x) && std::isfinite(f.y)))
            return texels_.at(floor.x, floor.y);
        const auto mix = [](Color a, Color b, double t) { return a + float(t) * (b - a); };
        return mix(mix(texels_.at(floor.x, floor.y), texels_.at(floor.x + 1, floor.y), f.x),
                   mix(texels_.at(floor.x, floor.y + 1), texels_.at(floor.x + 1, floor.y + 1), f.x), f.y);
    }

    Texels texels_;
    TexelRows rows_;  ///< of texels_
    glm::dmat3 fromSurface_;
    bool isSmooth_, isAffine_, isMove_;
    mutable std::vector<std::uint8_t> nearest_;  ///< what stored() gave
    dvec2 right_, up_;                           ///< from a pixel to its neighbours; of affine maps
};

}  // namespace

std::unique_ptr<PixelSource> texelSource(const Texels& texels, const glm::dmat3& fromSurface, bool isSmooth) {
    return std::make_unique<TexelSource>(texels, fromSurface, isSmooth);
}

}  // namespace vtm::openvg

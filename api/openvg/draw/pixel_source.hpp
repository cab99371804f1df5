/// \file
/// What the pixels of one drawing call are coloured by: paint generation and image interpolation
/// (specification sections 2.6, 2.7, 9 and 10.8).
#pragma once

#include <memory>
#include <optional>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "api/openvg/paint/color.hpp"
#include "api/openvg/state/objects.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

/// Pixels of an image's format from an address on.
struct StoredRow {
    const std::uint8_t* pixels;
};

struct SourceDescription;

class PixelSource {
public:
    explicit PixelSource(ColorSpace space) : space_(space) {}
    virtual ~PixelSource() = default;

    /// Of what colors() gives, which is premultiplied whatever this says of that.
    ColorSpace space() const { return space_; }

    /// Of the pixels from (x, y) on to the right, each at its centre.
    virtual void colors(int x, int y, std::span<Color> colors) const = 0;
    /// If all pixels have the same colour.
    virtual std::optional<Color> constant() const { return std::nullopt; }
    /// The format that stored() gives pixels in; null if it never does.
    virtual const PixelFormat* storedFormat() const { return nullptr; }
    /// If the colours of `count` pixels are those of an image, pixel for pixel. Valid until the next call.
    virtual std::optional<StoredRow> stored(int /*x*/, int /*y*/, int /*count*/) const {
        return std::nullopt;
    }
    /// The source, to be computed elsewhere; it refers to the source and what that refers to. False if there
    /// are no words for it.
    virtual bool describe(SourceDescription& /*description*/) const { return false; }

private:
    ColorSpace space_;
};

/// A premultiplied colour in sRGB.
std::unique_ptr<PixelSource> constantSource(Color color);

/// `paintToSurface`: from the paint's coordinates. Null if it cannot be inverted, when nothing is drawn
/// (section 9). Reads the paint, its pattern and `state`; they must stay.
std::unique_ptr<PixelSource> paintSource(const Paint& paint, const glm::mat3& paintToSurface,
                                         const State& state);

/// The paint of a mode: VG_FILL_PATH or VG_STROKE_PATH.
const Paint& currentPaint(const State& state, VGPaintMode mode);

/// A radial gradient's focus, moved into the circle if it is not well inside (section 9.3.2).
glm::dvec2 insideFocus(const Paint& paint);

/// Whether an image is interpolated: the best that it allows and the context does not forbid.
bool isSmooth(const Image& image, const State& state);

/// An image's colours, taken at the quality that the context and the image both allow, its border pixels
/// going on outside. Null if the matrix cannot be inverted.
std::unique_ptr<PixelSource> imageSource(const Image& image, const glm::mat3& imageToSurface,
                                         const State& state);

/// Channel by channel, in the image's space; grey images give RGB (section 10.8, VG_DRAW_IMAGE_MULTIPLY).
std::unique_ptr<PixelSource> productSource(std::unique_ptr<PixelSource> image,
                                           std::unique_ptr<PixelSource> paint);

}  // namespace vtm::openvg

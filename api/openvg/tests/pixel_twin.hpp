/// \file
/// Pixels computed one by one in the plainest way: what the library's rows are compared with.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <VG/openvg.h>

#include "api/openvg/draw/blend.hpp"
#include "api/openvg/image/pixels.hpp"

namespace vtm::openvg::testing {

/// A rectangle of words of a format.
struct TwinImage {
    VGImageFormat name;
    PixelFormat format;
    int width, height;
    std::vector<std::uint32_t> words;

    TwinImage(VGImageFormat imageName, int w, int h);
    std::uint32_t& word(int x, int y) { return words[std::size_t(y * width + x)]; }
    std::uint32_t word(int x, int y) const { return const_cast<TwinImage*>(this)->word(x, y); }
    /// Premultiplied, in the format's space.
    Color color(int x, int y) const;

    /// As memory that vgImageSubData reads, `stride()` bytes a row.
    std::vector<std::uint8_t> bytes() const;
    VGint stride() const { return VGint((std::size_t(width) * format.bits + 7) / 8); }
    void setBytes(const std::vector<std::uint8_t>& bytes);
};

/// Premultiplied colours at (x, y) of the surface, and the space that they are in.
struct TwinSource {
    ColorSpace space;
    std::function<Color(int x, int y)> color;
};

/// How a source gets into a surface.
struct TwinDrawing {
    VGint blendMode = VG_BLEND_SRC_OVER;
    std::optional<std::array<VGfloat, 8>> colorTransform;
    std::function<float(int x, int y)> coverage = [](int, int) { return 1.0f; };

    /// What a pixel of `surface` is afterwards, premultiplied, unrounded.
    Color drawn(const TwinImage& surface, const TwinSource& source, int x, int y) const;
};

/// An image under a map from the surface, its border pixels going on outside: nearest, or between four.
TwinSource nearest(const TwinImage& image, const glm::dmat3& fromSurface);
TwinSource bilinear(const TwinImage& image, const glm::dmat3& fromSurface);

/// Whether a stored word is a colour: each channel within half a step of its own and half a 255th,
/// premultiplied where the format is not.
bool isNear(const PixelFormat& format, std::uint32_t word, Color premultiplied);

}  // namespace vtm::openvg::testing

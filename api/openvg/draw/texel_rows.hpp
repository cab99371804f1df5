/// \file
/// Rows of an image's colours at places that are equally far from each other.
#pragma once

#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "api/openvg/draw/texel_source.hpp"
#include "api/openvg/image/pixel_rows.hpp"
#include "api/openvg/paint/lanes.hpp"

namespace vtm::openvg {

/// Whole numbers are the corners of texels. No place is above 2^30.
class TexelRows {
public:
    explicit TexelRows(const Texels& texels);

    /// Where an affine map leads from (x, y), (x + 1, y) …, each by itself: on a border between texels every
    /// rounding shows.
    void nearest(const glm::dmat3& map, glm::dvec2 place, std::span<Color> colors) const;
    /// The same as they are stored, of a tiling that has no other colours.
    void nearestStored(const glm::dmat3& map, glm::dvec2 place, int count, std::uint8_t* pixels) const;
    /// At first, first + step, …
    void bilinear(glm::dvec2 first, glm::dvec2 step, std::span<Color> colors) const;

private:
    /// Calls f with what reads a texel as this image stores it.
    template <class Function>
    void withTexel(Function&& f) const;
    /// Calls f(x, y) with the texel of each place.
    template <class Function>
    void walk(const glm::dmat3& map, glm::dvec2 place, std::size_t count, Function&& f) const;
    template <class Texel>
    Float4 anywhere(const Texel& texel, int x, int y) const;
    /// From what texels are read as to colours.
    void finish(std::span<Color> colors) const;

    const Texels& texels_;
    std::optional<ByteOrder> order_;  ///< read as bytes: premultiplied numbers up to 255 in their order
    Float4 fill_;
};

}  // namespace vtm::openvg

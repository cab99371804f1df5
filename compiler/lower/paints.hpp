/// \file
/// Scene paints to the asset's records.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/paint.hpp>
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// A linear gradient along x, from 0 to 1.
struct Ramp {
    scene::Affine toRamp;  ///< picture to the ramp's space
    std::vector<scene::GradientStop> stops;
    scene::Spread spread = scene::Spread::Pad;
};

/// The same colours in [0, size.x] × [0, size.y]; nothing if these are so much of the ramp that single
/// precision will do. The asset's matrices are single precision: of a ramp that is 2^30 times as long as the
/// picture, a sharp stop could be placed nowhere in it. So the part of the ramp that the picture shows
/// becomes a ramp of its own.
std::optional<Ramp> narrowed(const Ramp& ramp, glm::dvec2 size);

/// A radial gradient as a linear one, where its circles are nearly straight all over the picture, so that no
/// colour is farther off than a 2^13th of the picture's size; else nothing. `toUnit` leads from the picture
/// to the space in which the end circle is the unit circle.
std::optional<Ramp> straightened(const scene::RadialGradient& gradient, const scene::Affine& toUnit,
                                 glm::dvec2 size);

/// Appends sources to a picture, each distinct bitmap and material once. More than asset::maxMaterials are a
/// LimitError, and so are bitmaps of more than image::maxDecodedPixels together.
class PaintTable {
public:
    PaintTable(LoweredScene& picture, const Excerpt& excerpt)
        : picture_(picture), size_(excerpt.width, excerpt.height), isPart_(excerpt.isPart) {}

    /// The index of a new source; nothing if the paint's space is flat, so that nothing can be
    /// painted. Patterns are not paints here: lowering expands them.
    std::optional<std::uint32_t> add(const scene::Paint& paint, const scene::Affine& itemTransform);

private:
    std::uint32_t add(Source source);
    std::optional<std::uint32_t> solid(const scene::Color& color);
    std::optional<std::uint32_t> linear(const scene::LinearGradient& gradient,
                                        const scene::Affine& toPicture);
    std::optional<std::uint32_t> radial(const scene::RadialGradient& gradient,
                                        const scene::Affine& toPicture);
    std::optional<std::uint32_t> bitmap(const scene::ImagePaint& image, const scene::Affine& toPicture);
    std::optional<std::uint32_t> material(const scene::Material& material, const scene::Affine& toPicture);
    std::uint32_t record(asset::Gradient gradient, const std::vector<scene::GradientStop>& stops);
    /// In single precision; `toPaint`: the picture's space to the paint's.
    std::array<float, 6> numbers(const scene::Affine& toPaint) const;

    std::uint32_t ramp(const Ramp& ramp);

    LoweredScene& picture_;
    const glm::dvec2 size_;
    const bool isPart_;
    std::int64_t imagePixels_ = 0;
    std::map<const image::Bitmap*, std::uint32_t> images_;
    std::map<std::string, std::uint32_t> materials_;  ///< by name: a valid scene has one text for each
};

}  // namespace vtm::compiler

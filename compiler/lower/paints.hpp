/// \file
/// Scene paints to the asset's records.
#pragma once

#include <map>
#include <string>

#include "compiler/lower/lower.hpp"
#include "compiler/lower/narrow_gradient.hpp"

namespace vtm::compiler {

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

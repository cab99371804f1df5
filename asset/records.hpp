/// \file
/// The records that lie in Asset::data, read where they lie.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <span>

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// The record that begins at a texel.
template <class Record>
Record recordAt(std::span<const Texel> data, std::size_t texel) {
    std::array<Texel, sizeof(Record) / sizeof(Texel)> texels;
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = data[texel + i];
    return std::bit_cast<Record>(texels);
}

/// A gradient with its stops. `stopColors`: by texel of data, straight colours in [0, 1] where a stop stands.
class GradientView {
public:
    GradientView(std::span<const Texel> data, std::span<const glm::vec4> stopColors, std::size_t texel)
        : stops_(data.data() + texel + headTexels),
          colors_(stopColors.data() + texel + headTexels),
          gradient_(recordAt<Gradient>(data, texel)) {}

    static constexpr std::size_t headTexels = sizeof(Gradient) / sizeof(Texel);

    const Gradient& gradient() const { return gradient_; }
    std::size_t size() const { return gradient_.stopCount; }
    float offset(std::size_t stop) const { return std::bit_cast<float>(stops_[stop][0]); }
    const glm::vec4& color(std::size_t stop) const { return colors_[stop]; }

private:
    const Texel* stops_;
    const glm::vec4* colors_;
    Gradient gradient_;
};

}  // namespace vtm::asset

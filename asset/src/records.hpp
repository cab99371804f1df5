/// \file
/// The records that lie in Asset::data, read where they lie.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <span>

#include "asset/asset.hpp"

namespace vtm::asset {

/// The record that begins at a texel.
template <class Record>
Record recordAt(std::span<const Texel> data, std::size_t texel) {
    std::array<Texel, sizeof(Record) / sizeof(Texel)> texels;
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = data[texel + i];
    return std::bit_cast<Record>(texels);
}

/// A gradient with its stops.
class GradientView {
public:
    GradientView(std::span<const Texel> data, std::size_t texel)
        : data_(data),
          firstStop_(texel + sizeof(Gradient) / sizeof(Texel)),
          gradient_(recordAt<Gradient>(data, texel)) {}

    const Gradient& gradient() const { return gradient_; }
    std::size_t size() const { return gradient_.stopCount; }
    GradientStop stop(std::size_t i) const { return recordAt<GradientStop>(data_, firstStop_ + i); }

private:
    std::span<const Texel> data_;
    std::size_t firstStop_;
    Gradient gradient_;
};

}  // namespace vtm::asset

/// \file
/// How a filter's primitives are read from their words (vtm/asset/asset.hpp).
#pragma once

#include <bit>
#include <cstddef>
#include <span>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// What a primitive's inputs name: 0 and 1 stand for the filtered picture and its alpha.
inline constexpr std::uint32_t sourceGraphic = 0, sourceAlpha = 1, firstResult = 2;

inline constexpr std::size_t maxOctaves = 24;  ///< of Turbulence

inline std::span<const FilterPrimitive> primitivesOf(const AssetView& asset, const Filter& filter) {
    return asset.filterPrimitives.subspan(filter.firstPrimitive, filter.primitives);
}

inline std::span<const std::uint32_t> inputsOf(const AssetView& asset, const FilterPrimitive& primitive) {
    return asset.filterWords.subspan(primitive.firstWord, primitive.inputs);
}

/// The parameters, as floats.
class FilterParameters {
public:
    explicit FilterParameters(std::span<const std::uint32_t> words) : words_(words) {}
    std::size_t size() const { return words_.size(); }
    float operator[](std::size_t i) const { return std::bit_cast<float>(words_[i]); }
    FilterParameters from(std::size_t first) const { return FilterParameters(words_.subspan(first)); }

private:
    std::span<const std::uint32_t> words_;
};

inline FilterParameters parametersOf(const AssetView& asset, const FilterPrimitive& primitive) {
    return FilterParameters(
        asset.filterWords.subspan(std::size_t(primitive.firstWord) + primitive.inputs, primitive.parameters));
}

}  // namespace vtm::asset

/// \file
/// The operations of filters on pixels: layers in, a layer out. `scale`: pixels of the filter's raster per
/// user unit, along its axes. Every input has the colour space of the result; of DisplacementMap only the
/// second, and the result has that of the first. Source: Filter Effects Module
/// Level 1, section 9; vtm/scene/filter.hpp says what each computes.
///
/// A result may have a smaller box than was asked for: layers are transparent beyond their boxes.
#pragma once

#include <span>

#include <glm/vec2.hpp>

#include "asset/filters.hpp"
#include "raster/filter/layer.hpp"
#include "raster/filter_place.hpp"

namespace vtm::asset {

/// What an operation is done with.
struct FilterStep {
    FilterParameters parameters;
    std::span<const Layer* const> inputs;
    std::span<const PixelRect> regions;  ///< of the inputs
    PixelBox box;                        ///< of the result
    bool linear = false;
    glm::dvec2 scale{1}, origin{0};  ///< pixel = scale · point of the user space + origin
    bool inWholePixels = false;      ///< offsets are rounded
};

/// Multiplies the pixels by the share of them that lies in the rectangle.
void cut(Layer& layer, const PixelRect& to);

// per_pixel.cpp
Layer blendLayers(const FilterStep& step);
Layer colorMatrix(const FilterStep& step);
Layer componentTransfer(const FilterStep& step);
Layer composite(const FilterStep& step);
Layer merge(const FilterStep& step);
Layer flood(const FilterStep& step);

// blur.cpp
Layer gaussianBlur(const FilterStep& step);
Layer dropShadow(const FilterStep& step);

// neighbours.cpp
Layer convolve(const FilterStep& step);
Layer morphology(const FilterStep& step);

// move.cpp
Layer offset(const FilterStep& step);
Layer displace(const FilterStep& step);
Layer tile(const FilterStep& step);

// lighting.cpp
Layer lighting(const FilterStep& step);

// turbulence.cpp
Layer turbulence(const FilterStep& step);

}  // namespace vtm::asset

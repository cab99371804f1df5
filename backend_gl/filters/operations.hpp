/// \file
/// The operations of filters on the GPU. Twins of raster/filter/operations.hpp, which says what each
/// computes.
#pragma once

#include <span>

#include "asset/filters.hpp"
#include "backend_gl/filters/filter_layers.hpp"

namespace vtm::gl {

/// What an operation is done with.
struct FilterStep {
    const asset::FilterPrimitive& primitive;
    asset::FilterParameters parameters;
    std::span<const FilterLayer* const> inputs;
    std::span<const asset::PixelRect> regions;  ///< of the inputs; of the primitive where it has none
    const asset::FilterPlace& place;
    asset::PixelRect own;  ///< the primitive's subregion, to which its result is cut
};

// Each draws a layer whose box is not empty.

// operations.cpp
/// Whatever the primitive is, but Picture.
void drawStep(FilterLayers& layers, const FilterStep& step, const FilterLayer& result);
void drawCopy(FilterLayers& layers, const FilterLayer& input, const asset::PixelRect& cut,
              const FilterLayer& result);

// blur.cpp
/// `deviation` in pixels.
void drawBlurred(FilterLayers& layers, const FilterLayer& input, glm::dvec2 deviation,
                 const asset::PixelRect& cut, const FilterLayer& result);

// morphology.cpp
void drawExtremes(FilterLayers& layers, const FilterStep& step, const FilterLayer& result);

// turbulence.cpp
void drawTurbulence(FilterLayers& layers, const FilterStep& step, const FilterLayer& result);

}  // namespace vtm::gl

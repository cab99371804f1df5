/// \file
/// What a paint program has of the pixels in which it is rough (raster/src/rough.hpp): drawn finer, and
/// averaged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/src/boundary_chords.hpp"
#include "raster/src/float4.hpp"
#include "raster/src/program_pixels.hpp"
#include "raster/src/row_sums.hpp"
#include "raster/src/scan_programs.hpp"

namespace vtm::asset {

/// Pixels first to end - 1 of rows top to bottom - 1 of a band.
struct BandBox {
    int first, end, top, bottom;

    int width() const { return end - first; }
    int height() const { return bottom - top; }
};

class FinerProgram {
public:
    /// Those of a band's pixels, some more than once, of which rows begin at `top`; their order changes. Adds
    /// the program's colours, times its share of the pixel, to the band's sums.
    void draw(const ProgramView& of, std::uint32_t paint, int top, std::span<const ProgramSide> sides,
              std::span<BandPixel> pixels, Accumulator<Float4>& sums);

private:
    void drawBox(const ProgramView& of, std::uint32_t paint, int top, std::span<const ProgramSide> sides,
                 const BandBox& box, std::span<const BandPixel> pixels);
    Float4& meanAt(const BandBox& box, int row, int x) {
        return means_[std::size_t(row) * std::size_t(box.width()) + std::size_t(x)];
    }
    void addToMeans(const BandBox& box, int row, int first, int end, Float4 color);

    std::vector<Float4> means_;  ///< of a box's pixels
    // Of the finer picture of a box.
    Bands bands_;
    BandPrograms programs_;
    Accumulator<Float4> sums_;
};

}  // namespace vtm::asset

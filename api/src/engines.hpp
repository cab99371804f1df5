/// \file
/// Who draws for a Picture: the CPU here, shaders through libvtm_gl where that is there.
#pragma once

#include <optional>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "image/pixel_writer.hpp"

namespace vtm {

/// The scanner for exact pictures, kept from one drawing to the next; the evaluator for others.
class CpuEngine {
public:
    explicit CpuEngine(const asset::Asset& asset);
    /// Row by row.
    void draw(const asset::View& view, const image::PixelWriter& writer, const image::RowSink& sink) const;

private:
    const asset::Asset& asset_;
    std::optional<asset::Scanner> scanner_;
};

/// Shaders, in a context of the library's own; the caller's stays current. Nothing where the CPU is faster,
/// or where there is no GL and it is not `required`. Throws gl::GlError.
std::optional<image::Raster> drawWithGl(const asset::Asset& asset, const asset::View& view, bool required);

}  // namespace vtm

/// \file
/// Bitmaps in, scenes out: vectorising (paper row 15). The outlines are found by potrace, whose library is
/// loaded when it is first needed, since its licence is the GPL: what is built here does not contain it.
/// Where it is not installed, or its header was not when this was built, `available()` is false.
#pragma once

#include <vtm/error.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::trace {

struct Options {
    /// Colours of the result, at most, in [1, 256]. Fewer where the picture has fewer.
    int colors = 8;
    /// Spots of so many pixels are left out, in [0, 1000000].
    int speckle = 2;
    /// Corners are rounded more the larger it is: from 0, polygons, to 1.3334, no corners.
    double smooth = 1;
};

/// Says why nothing can be traced: options out of range, an empty picture, no potrace.
class TraceError : public Error {
    using Error::Error;
};

/// Whether potrace can be used.
bool available();

/// A scene of the picture's size in pixels, one item a colour. Colours are clustered by how far apart they
/// look (OKLab). They are stacked, the lightest at the bottom: each covers its own pixels and those of all
/// darker ones, so that no gap shows between them. Pixels of which less than half is covered (alpha below
/// 128) stay empty, others count as opaque.
scene::Scene trace(const image::Bitmap& bitmap, const Options& options = {});

}  // namespace vtm::trace

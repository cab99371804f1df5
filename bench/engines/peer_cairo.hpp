/// \file
/// cairo's image surface as a peer that is given our outlines.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vtm/image/bitmap.hpp>
#include "bench/engines/shape.hpp"

namespace vtm::bench {

/// "cairo 1.2.3"; nothing where we were built without it.
std::optional<std::string> cairoVersion();

/// Draws shapes in order into an image in memory. Does nothing where cairo is missing.
class CairoCanvas {
public:
    CairoCanvas(int width, int height);
    ~CairoCanvas();
    CairoCanvas(CairoCanvas&&) noexcept;
    CairoCanvas& operator=(CairoCanvas&&) noexcept;

    int width() const;
    int height() const;
    /// On `ground`, which replaces what was there.
    void draw(const std::vector<Shape>& shapes, const scene::Affine& view, const scene::Color& ground);
    /// What the last call drew.
    image::Bitmap pixels() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::bench

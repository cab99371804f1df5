/// \file
/// Work that is pixels rather than outlines: images, gradients, uploads and copies.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vtm/vg.h>

namespace vtm::bench {

/// The side of the surface that is drawn into, and from which a corner is read back, and of the square images
/// that are moved and copied.
inline constexpr int workSide = 800, movedSide = 256, copiedSide = 512;

/// Glyphs in lines, about 14 pixels high; the same in every frame.
inline constexpr int textLines = 40, lineGlyphs = 43;
inline constexpr double glyphAdvance = 18.37, lineAdvance = 19;

/// A frame of one kind of work. Frames of a name are the same in all engines.
struct PixelWork {
    std::string name;
    std::function<void(int frame)> draw;
};

/// Pixels with every alpha, premultiplied: four bytes each in the order of cairo's words.
std::vector<std::uint32_t> premultipliedPixels(int side);

/// Through OpenVG. What it returns owns its context, which is current.
std::vector<PixelWork> vgPixelWork(VtmCompositor compositor = VTM_COMPOSITOR_CPU);

/// Through cairo; empty where cairo is missing. It cannot blur.
std::vector<PixelWork> cairoPixelWork();

}  // namespace vtm::bench

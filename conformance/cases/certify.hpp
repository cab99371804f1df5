/// \file
/// The certified error: an asset against the true outlines of its scene, through the exact reference, which
/// shares nothing with the compiler.
#pragma once

#include <string>
#include <vector>

#include "asset/asset.hpp"
#include "conformance/reference/reference.hpp"
#include "scene/scene.hpp"

namespace vtm::cases {

/// A square grid of square pixels on the picture.
struct Window {
    scene::Point centre;
    double pixel;      ///< side, picture units
    int pixels;        ///< a side of the window
    double tolerance;  ///< of the asset, picture units
};

/// All outlines of a scene that has neither patterns nor masks: its items', its clips' and the picture's
/// border.
class Outlines {
public:
    explicit Outlines(const scene::Scene& scene);

    /// The pixels that no outline comes nearer to than one pixel, row by row.
    std::vector<bool> farPixels(const Window& window) const;
    /// Whether an outline runs through the square with this centre and half its side.
    bool within(scene::Point centre, double reach, double tolerance) const;
    /// Points on or about the outlines: anywhere on a path, for a stroke half its width beside.
    std::vector<scene::Point> somePoints(std::uint64_t seed, int count) const;

private:
    struct Shape {
        std::shared_ptr<const scene::Path> path;
        scene::Affine transform;
        std::variant<scene::FillRule, scene::StrokeStyle> geometry;
    };
    void add(const scene::Group& group);
    void add(const scene::Clip& clip);
    /// Which pixels the outline runs through. A stroke covers a pixel safely if one narrower by the tolerance
    /// on both sides does: where its parts just overlap, outlines run inside it.
    static std::vector<bool> touched(const Shape& shape, const reference::View& view, double tolerance);

    std::vector<Shape> shapes_;
};

/// Compares colours where no outline is near: there an asset whose boundaries lie within a pixel of the true
/// ones shows what the reference shows, up to `bound` and what a gradient varies within a pixel. Empty, or
/// the first pixel that differs.
std::string difference(const scene::Scene& scene, const Outlines& outlines, const asset::Asset& asset,
                       const Window& window, double bound);

/// Colours are rounded to single precision. Where the sides of a stroke coincide and so leave no mark in its
/// coverage, rounding to the lattice (64 steps to the tolerance, vertices on even ones) may open them by two
/// steps: a share of the pixel that is far below it in pixels much larger than the tolerance.
inline constexpr double colourBound = 2.0 / 255, latticeOpening = 2.0 / 64;

}  // namespace vtm::cases

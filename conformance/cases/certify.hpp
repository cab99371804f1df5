/// \file
/// The certified error: an asset against the true outlines of its scene, through the exact reference, which
/// shares nothing with the compiler.
#pragma once

#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/scene/scene.hpp>
#include "conformance/reference/reference.hpp"

namespace vtm::cases {

/// A square grid of square pixels on the picture.
struct Window {
    scene::Point centre;
    double pixel;      ///< side, picture units
    int pixels;        ///< a side of the window
    double tolerance;  ///< of the asset, picture units
    double angle = 0;  ///< by which the picture is turned in it
};

scene::Affine toPixels(const Window& window);

/// A point of an outline and its unit normal, in the picture.
struct OutlinePoint {
    scene::Point at, normal;
};

/// All outlines of a scene that has neither patterns nor masks: its items', its clips' and the picture's
/// border.
class Outlines {
public:
    explicit Outlines(const scene::Scene& scene);

    /// The pixels that no outline comes nearer to than one pixel, row by row.
    std::vector<bool> farPixels(const Window& window) const;
    /// How much of each pixel lies, at most, within the window's tolerance of an outline: as so many parts a
    /// side show it, the pixel itself but for a rim of pixels round the window.
    std::vector<double> nearShares(const Window& window, int parts) const;
    /// Distance of a point from the nearest outline, up to `maximum`, beyond which it is infinite. By
    /// octagons about the point: up to 8 % less than the true one, and by a 64th of `maximum` more or less.
    double distance(scene::Point from, double maximum) const;
    /// Whether an outline is as near to a point, to the same precision: much faster than distance().
    bool isNear(scene::Point point, double reach) const;
    /// Whether an outline runs through the square with this centre and half its side.
    bool within(scene::Point centre, double reach, double tolerance) const;
    /// Points on or about the outlines: anywhere on a path, for a stroke half its width beside.
    std::vector<scene::Point> somePoints(std::uint64_t seed, int count) const;
    /// Points exactly on the outlines of fills and on the offset curves of strokes, where neither caps nor
    /// joins are, which may be hidden. Fewer than `count`, as not every draw hits a line or a curve.
    std::vector<OutlinePoint> pointsOn(std::uint64_t seed, int count) const;

private:
    struct Shape {
        std::shared_ptr<const scene::Path> path;
        scene::Affine transform;
        std::variant<scene::FillRule, scene::StrokeStyle> geometry;
        scene::Point min{0}, max{0};  ///< what it cannot leave
    };
    void add(Shape shape);
    void add(const scene::Group& group);
    void add(const scene::Clip& clip);
    /// Which pixels the outline runs through. A stroke covers a pixel safely if one narrower by the tolerance
    /// on both sides does: where its parts just overlap, outlines run inside it.
    static std::vector<bool> touched(const Shape& shape, const reference::View& view, double tolerance);
    /// By two squares about the point that make an octagon.
    static bool isNear(const Shape& shape, scene::Point point, double reach, double tolerance);
    /// The shapes that may come into the window.
    std::vector<const Shape*> shapesIn(const Window& window) const;
    /// The pixels that any outline runs through.
    std::vector<bool> touched(const Window& window) const;

    std::vector<Shape> shapes_;
};

/// Compares colours where no outline is near: there an asset whose boundaries lie within a pixel of the true
/// ones shows what the reference shows, up to `bound` and what a gradient varies within a pixel. Empty, or
/// the first pixel that differs.
std::string difference(const scene::Scene& scene, const Outlines& outlines, const asset::Asset& asset,
                       const Window& window, double bound);

/// Whether the asset shows one colour all about a point, however it is stored: what is hidden on one side of
/// a border may still be part of a paint's program on the other. `pixel`: half the side of what is looked at.
bool looksEqualAbout(const asset::Asset& asset, scene::Point p, double pixel);

/// Colours are rounded to single precision. Where the sides of a stroke coincide and so leave no mark in its
/// coverage, rounding to the lattice (64 steps to the tolerance, vertices on even ones) may open them by two
/// steps: a share of the pixel that is far below it in pixels much larger than the tolerance.
inline constexpr double colourBound = 2.0 / 255, latticeOpening = 2.0 / 64;

}  // namespace vtm::cases

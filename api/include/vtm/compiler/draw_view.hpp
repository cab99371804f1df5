/// \file
/// Drawing one view of a scene without compiling it: for pictures that are drawn once.
///
/// An asset divides the whole picture into regions. What is drawn once needs regions only where pixels are
/// mixed; so chains of boundaries are followed down the rows, and are cut against each other where they meet
/// (docs/direct.md). The picture is the same mean over each pixel's area that the asset's scanner draws.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::compiler {

/// A scene that is ready to be drawn for one view. Safe to use from several threads at once.
class ViewDrawing {
public:
    /// Null where compiling is the way to draw: scenes with materials, and with patterns of many tiles, which
    /// assets place. What has filters in it is drawn at once, and held as pixels. Boundaries are as exact as
    /// compileView() makes them; of `options` the tolerance counts, and the mode must be Exact. The scene is
    /// not needed afterwards. Throws as compileView() does.
    static std::unique_ptr<const ViewDrawing> make(const scene::Scene& scene, const scene::Frame& frame,
                                                   const Options& options = {});
    /// The same for any affine view of the whole scene. Throws as compile() does, and std::length_error if
    /// the view is beyond its limits (vtm/raster/view.hpp).
    static std::unique_ptr<const ViewDrawing> make(const scene::Scene& scene, const asset::View& view,
                                                   const Options& options = {});
    ~ViewDrawing();
    ViewDrawing(const ViewDrawing&) = delete;
    ViewDrawing& operator=(const ViewDrawing&) = delete;

    int width() const;   ///< pixels
    int height() const;  ///< pixels
    /// As Result::warnings.
    const std::vector<std::string>& warnings() const;

    /// Replaces every pixel, rounded to nearest. On all processors; the bytes do not depend on their number.
    /// Throws LimitError where the format of an asset could not hold a paint.
    void draw(const asset::ByteTarget& target) const;
    /// The same in floats.
    image::Raster draw() const;
    /// Calls take(y, run) for runs of pixels that make up the rows from `first` to `end` - 1, from left to
    /// right in each; the colours are premultiplied, and not clamped. Bands of asset::bandRows rows are drawn
    /// at the same time, and `take` is called for several of them at once.
    void scan(int first, int end, const std::function<void(int y, const asset::ColorRun& run)>& take) const;

private:
    friend struct DrawnPixels;  // of the library
    struct Impl;
    explicit ViewDrawing(std::unique_ptr<const Impl> impl);
    std::unique_ptr<const Impl> impl_;
};

}  // namespace vtm::compiler

#pragma GCC visibility pop

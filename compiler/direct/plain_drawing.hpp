/// \file
/// A scene without filters and one view of it in, pixels out.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// Safe to use from several threads at once.
class PlainDrawing {
public:
    /// `view`: of the excerpt, within its limits. Null if there are patterns of many tiles, or materials,
    /// which assets place. The scene must be valid, and is not needed afterwards. Throws as compile() does.
    static std::unique_ptr<const PlainDrawing> make(const scene::Scene& scene, const Excerpt& excerpt,
                                                    const asset::View& view, Options options);
    ~PlainDrawing();
    PlainDrawing(const PlainDrawing&) = delete;
    PlainDrawing& operator=(const PlainDrawing&) = delete;

    const std::vector<std::string>& warnings() const;

    // As ViewDrawing has them.
    void draw(const asset::ByteTarget& target) const;
    image::Raster draw() const;
    void scan(int first, int end, const std::function<void(int y, const asset::ColorRun& run)>& take) const;
    /// Adds what it draws, each channel in [0, 1]; asks for the pixels that are not transparent, of several
    /// rows at once.
    void add(const asset::PixelsToAddTo& pixels) const;
    /// Lays it over the pixels.
    void layOver(float opacity, const asset::PixelsToAddTo& pixels) const;

private:
    struct Impl;
    explicit PlainDrawing(std::unique_ptr<const Impl> impl);
    std::unique_ptr<const Impl> impl_;
};

}  // namespace vtm::compiler

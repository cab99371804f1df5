/// \file
/// Drawing one asset several times on the CPU, whatever its commands do.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/difference.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>

#pragma GCC visibility push(default)

namespace vtm::asset {

struct EvaluatorOptions {
    /// Keeps what filters made under the view that draw() drew last, for drawBox() under the same view, which
    /// makes only those anew into which something else goes now. Takes 16 bytes for each pixel of each
    /// filter's result, 64 MiB at most, and some of draw()'s time. Not where there are materials.
    bool keepsFilterResults = false;
};

/// Draws what evaluate() draws, and keeps what drawings share: paints, and of pictures with filters the
/// boundaries of their maps. Safe to use from several threads at once, except for update().
class Evaluator {
public:
    /// `asset` must be valid (asset::validate) and outlive it.
    explicit Evaluator(const AssetView& asset);
    Evaluator(const AssetView& asset, const EvaluatorOptions& options);
    ~Evaluator();
    Evaluator(Evaluator&&) noexcept;
    Evaluator& operator=(Evaluator&&) noexcept;

    /// Goes on to the next asset, which must outlive it, `difference` being what changed from the last one
    /// that was given; that may be gone. Boundaries of maps that did not change are not made anew. If it
    /// throws, nothing may be drawn before an update succeeds without `difference.maps`.
    void update(const AssetView& asset, const Difference& difference);

    /// Throws std::length_error if the view exceeds the limits in vtm/raster/view.hpp, as all below.
    image::Raster draw(const View& view, const MaterialFunction& materials = {}) const;
    /// Replaces every pixel, rounded to nearest.
    void draw(const View& view, const ByteTarget& target, const MaterialFunction& materials = {}) const;
    /// Replaces the pixels of a box of the view alone, as the whole would show them; `target` is the view's.
    void drawBox(const View& view, const PixelBox& box, const ByteTarget& target,
                 const MaterialFunction& materials = {}) const;
    /// Gives the rows from the top, four floats a pixel.
    void scan(const View& view, const std::function<void(std::span<const float> row)>& take,
              const MaterialFunction& materials = {}) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::asset

#pragma GCC visibility pop

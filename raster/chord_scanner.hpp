/// \file
/// Drawing from chords that somebody else makes, band by band: what is drawn once needs no asset
/// (compiler/direct).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "raster/chord.hpp"

namespace vtm::asset {

class Images;
/// Those of an asset, for all assets of the same images whose paints read the same of them.
std::shared_ptr<const Images> imagesOf(const AssetView& asset);

/// The paints of chords. The first numbers are those of the asset's paints, all of which are programs; the
/// next ones are colours, premultiplied.
struct ChordPaints {
    const AssetView& asset;
    const std::shared_ptr<const Images>& images;  ///< of the asset
    std::span<const glm::vec4> colors;
};

/// Draws bands of one view, in any order. For one thread.
class ChordScanner {
public:
    /// Throws std::length_error if the view is beyond its limits.
    explicit ChordScanner(const View& view);
    ~ChordScanner();

    /// Bands of bandRows rows, from `first` on: for each the chords that change a pixel of it. On the way
    /// along a row, from paint 0 on the left, each chord that is met has on its left the paint that one is
    /// in.
    void draw(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
              const ByteTarget& target);
    /// The same, as Scanner::scan gives it.
    void scan(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
              const std::function<void(int y, const ColorRun& run)>& take);
    /// The same, as Scanner::add gives it.
    void add(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
             const PixelsToAddTo& pixels);
    /// Lays it over the pixels.
    void layOver(int first, std::span<const std::vector<Chord>> bands, const ChordPaints& paints,
                 float opacity, const PixelsToAddTo& pixels);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::asset

/// \file
/// What an asset's commands draw where somebody else draws the maps: what is drawn once needs no trees
/// (compiler/direct).
#pragma once

#include <functional>
#include <memory>
#include <span>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::asset {

/// Draws the maps of commands of the kind DrawMap: several at once.
class MapDrawer {
public:
    virtual ~MapDrawer() = default;
    /// Adds what a command draws under a view of the asset's picture. `pixels` may be called for several rows
    /// at once.
    virtual void add(const Command& command, const View& view, const PixelsToAddTo& pixels,
                     const MaterialFunction& materials) const = 0;
    /// Lays that over the pixels.
    virtual void layOver(const Command& command, float opacity, const View& view, const PixelsToAddTo& pixels,
                         const MaterialFunction& materials) const = 0;

protected:
    MapDrawer() = default;
    MapDrawer(const MapDrawer&) = default;
    MapDrawer& operator=(const MapDrawer&) = default;
};

/// The picture under one view. It holds the pixels that were drawn, as floats.
class CommandPicture {
public:
    /// Of the asset only commands, filters and the maps' squares are read. Throws as Evaluator::draw does,
    /// and as `maps`.
    CommandPicture(const AssetView& asset, const View& view, const MapDrawer& maps);
    ~CommandPicture();
    CommandPicture(CommandPicture&&) noexcept;
    CommandPicture& operator=(CommandPicture&&) noexcept;

    /// Replaces every pixel, rounded to nearest.
    void draw(const ByteTarget& target) const;
    image::Raster draw() const;
    /// Gives rows `first` to `end` - 1, four floats a pixel in [0, 1].
    void giveRows(int first, int end, const std::function<void(std::span<const float> row)>& take) const;

private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

}  // namespace vtm::asset

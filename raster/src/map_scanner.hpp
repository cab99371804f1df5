/// \file
/// Scanning the maps that an asset's commands draw, each by itself.
#pragma once

#include <memory>

#include <vtm/raster/scan.hpp>
#include "raster/src/paint.hpp"

namespace vtm::asset {

/// The boundaries of a map are made when it is first drawn, and kept. Safe to use from several threads at
/// once.
class MapScanner {
public:
    /// The asset of the paints must outlive it.
    explicit MapScanner(const Paints& paints);
    ~MapScanner();
    MapScanner(MapScanner&&) noexcept;
    MapScanner& operator=(MapScanner&&) noexcept;

    /// Adds what a command of the asset draws, one of the kind DrawMap.
    void add(const Command& command, const View& view, const PixelsToAddTo& pixels,
             const MaterialFunction& materials) const;
    /// Lays that over the pixels.
    void layOver(const Command& command, float opacity, const View& view, const PixelsToAddTo& pixels,
                 const MaterialFunction& materials) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::asset

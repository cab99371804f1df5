/// \file
/// Scanning the maps that an asset's commands draw, each by itself.
#pragma once

#include <memory>
#include <span>

#include <vtm/asset/difference.hpp>
#include <vtm/raster/scan.hpp>
#include "raster/command_picture.hpp"
#include "raster/src/paint.hpp"

namespace vtm::asset {

/// The boundaries of a map are made when it is first drawn, and kept. Safe to use from several threads at
/// once.
class MapScanner : public MapDrawer {
public:
    /// The asset of the paints must outlive it.
    explicit MapScanner(const Paints& paints);
    /// Of the asset that follows that of `last`, whose boundaries it takes over.
    MapScanner(const Paints& paints, MapScanner&& last, std::span<const MapChange> changes);
    ~MapScanner() override;
    MapScanner(MapScanner&&) noexcept;
    MapScanner& operator=(MapScanner&&) noexcept;

    void add(const Command& command, const View& view, const PixelsToAddTo& pixels,
             const MaterialFunction& materials) const override;
    void layOver(const Command& command, float opacity, const View& view, const PixelsToAddTo& pixels,
                 const MaterialFunction& materials) const override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::asset

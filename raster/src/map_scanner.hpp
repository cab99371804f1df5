/// \file
/// Scanning maps of one asset, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <vtm/raster/scan.hpp>
#include "raster/src/paint.hpp"

namespace vtm::asset {

/// What maps share is made once. As Scanner, for one thread.
class MapScanner {
public:
    /// Must outlive it, and their asset too.
    explicit MapScanner(const Paints& paints);
    ~MapScanner();

    /// Adds a map (its number) whose paints are so many, from `firstPaint` on.
    void add(std::uint32_t map, std::uint32_t firstPaint, std::size_t paintCount, const View& view,
             const PixelsToAddTo& pixels, const MaterialFunction& materials);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::asset

/// \file
/// An asset's data on the GPU.
#pragma once

#include <optional>

#include <vtm/gl/renderer.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "backend_gl/core/features.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"
#include "backend_gl/layers/instances.hpp"
#include "backend_gl/tiles/atlas.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

/// First texels of the parts of the one texture that holds them all.
struct Sections {
    GLuint leaves = 0, pieces = 0, paints = 0, data = 0;
    GLuint images = 0;    ///< a texel a picture: first pixel, width, height
    GLuint rampSums = 0;  ///< beside the data (asset_texels.hpp)
    GLuint filterWords = 0;
};

/// Who computes pictures with filters.
enum class FilterEngine { Gpu, Cpu };

/// With filters that the CPU computes.
struct FilteredAsset {
    explicit FilteredAsset(const asset::AssetView& of) : asset(asset::toAsset(of)), evaluator(asset) {}
    FilteredAsset(const FilteredAsset&) = delete;  // the evaluator points into it
    FilteredAsset& operator=(const FilteredAsset&) = delete;

    const asset::Asset asset;
    const asset::Evaluator evaluator;
};

struct UploadedAsset {
    /// `maxTurns`: of a pixel (turns.hpp).
    UploadedAsset(const asset::AssetView& asset, unsigned materialSet, std::uint32_t maxTurns = turnsPerPixel,
                  FilterEngine filters = FilterEngine::Gpu);
    /// Whether update() can bring it to that asset.
    bool canUpdate(const asset::AssetView& asset, const asset::Difference& difference) const;
    /// Sends what changed; returns its bytes.
    std::size_t update(const asset::AssetView& asset, const asset::Difference& difference);
    UploadedAsset(const UploadedAsset&) = delete;  // atlases point into it
    UploadedAsset& operator=(const UploadedAsset&) = delete;

    std::vector<asset::Map> maps;
    std::vector<asset::Command> commands;
    InstanceList list;
    Features features;     ///< of the paint programs
    unsigned materialSet;  ///< of Programs
    std::vector<asset::Paint> paints;
    std::optional<double> finestPixel;
    std::optional<asset::Scanner> scanner;  ///< where pictures are scanned
    std::optional<FilteredAsset> filtered;  ///< nothing of it is uploaded
    asset::Asset filters;                   ///< the mode, and filters that the GPU computes
    bool isSumOfMaps;                       ///< else its commands are executed one by one
    KeptAsset kept;                         ///< where it has atlases
    std::vector<Atlas> atlases;             ///< exact: of each map drawn, in the order of the commands
    Sections sections;
    RecordTexture records;
    TextureHandle images;
    BufferHandle instances;

    /// By map, filled up to whole rows of the texture beside it, which changes with every view.
    std::vector<Placement> placements;
    TextureHandle placementTexels;
    /// Sends the rows that hold maps [first, last].
    void uploadPlacements(std::uint32_t first, std::uint32_t last);
};

struct Texture::Impl : UploadedAsset {
    using UploadedAsset::UploadedAsset;
};

}  // namespace vtm::gl

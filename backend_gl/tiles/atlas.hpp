/// \file
/// The tiles of one map on the GPU, made when a view first needs them and kept for the views that follow.
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/difference.hpp>
#include <vtm/raster/scan.hpp>
#include <vtm/raster/view.hpp>
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/placement.hpp"
#include "backend_gl/tiles/block_grid.hpp"
#include "backend_gl/tiles/tile.hpp"
#include "raster/steepness.hpp"

namespace vtm::gl {

/// What stays in main memory of a sum of maps.
struct KeptAsset {
    asset::Asset asset;                       ///< without commands, filters and prefilter
    std::vector<std::uint32_t> programTurns;  ///< by paint (turns.hpp)
    std::vector<asset::PaintChange> changes;  ///< by paint
};
KeptAsset keptOf(const asset::AssetView& asset);

/// What an update changed of paints that were there before.
struct PaintUpdate {
    std::vector<std::uint8_t> isChanged;  ///< by paint; none where nothing is
    bool programs = false;                ///< programs are other ones
    bool kinds = false;                   ///< solid ones became programs, or programs solid ones
};
/// Brings it to the next asset, that differs from the one before by squares and paints alone.
PaintUpdate update(KeptAsset& kept, const asset::AssetView& asset, const asset::Difference& difference);

/// Of one map and those in it, for one view after the other.
class ScannedPixels {
public:
    /// `asset` must outlive it.
    ScannedPixels(const asset::Asset& asset, std::uint32_t map, std::uint32_t firstPaint)
        : asset_(&asset), map_(map), firstPaint_(firstPaint) {
        command_.map = map;
    }

    /// The asset is another one now.
    void update(const asset::Difference& difference);
    /// Puts blocks of a box into the texture, each where scannedPlace() says. `corners`: their first pixels,
    /// row by row. Materials have their fallback colours.
    void scan(const asset::View& view, std::span<const glm::ivec2> corners, const PixelBox& box,
              const BlockGrid& grid, asset::Sums sums);
    /// RGBA32F: what tile shaders add up, premultiplied.
    const TextureHandle& texture() const { return texture_; }

private:
    const asset::Scanner& scannerFor(asset::Sums sums);
    asset::AssetView drawing() const;
    void send(glm::ivec2 size, const std::vector<glm::vec4>& pixels);

    const asset::Asset* asset_;
    std::uint32_t map_, firstPaint_;
    asset::Command command_;                                 ///< draws the map
    std::array<std::optional<asset::Scanner>, 2> scanners_;  ///< by Sums, made when first needed
    glm::ivec2 size_{0};
    TextureHandle texture_;
};

/// The level of the tiles for a view: their cells are at least `cellsPerRadius` footprints' radii wide and
/// less than twice that, so that what is made for one scale serves a whole octave.
int tileLevelFor(const asset::Map& map, const asset::View& view);
/// The largest of those radii, tile sides.
double tileMargin();

/// The ratio ρ of a view's largest stretch to its smallest up to which tiles are exact. A tile is less
/// than 64 of the pixels' longer sides wide, and 64 ρ of the shorter ones. So rounded ends, half a step each
/// way, are off by 64 ρ · 2^-17 · sqrt(2) = 0.0007 ρ pixels at most, which is 0.25 ρ / 255 of a pixel that a
/// boundary runs through; a slope's rounding, 7e-5 of 0.75 tiles, by 0.9 ρ / 255 in the middle of the
/// longest curve; and where a curve leaves its tangent within a pixel by `flatEnough` ρ = 0.006 ρ, by
/// (0.006 ρ)². That is 3.5/255 for ρ = 3 at the worst.
inline constexpr double maxStretchRatio = 3;
bool isStretched(const asset::View& view);

class Atlas {
public:
    /// `asset` must outlive it. `firstPaint`: the map's paint 0. A cell that would take more than `maxTurns`
    /// is crowded.
    Atlas(const KeptAsset& asset, std::uint32_t map, std::uint32_t firstPaint, std::uint32_t maxTurns);

    /// What is kept of a Tile.
    struct Placed {
        TilePaints paints = TilePaints::Solid;
        bool programs = false;  ///< those of programs among them
        bool hasLongLists = false;
        std::uint8_t kinds = 0;  ///< bits: of which CellKind there are cells
        float steepness = 0;
        std::uint32_t firstTexel = 0, firstPair = 0, pairs = 0, firstCell = 0, texelCount = 0;
        CellGrid grid;
        std::uint64_t used = 0;  ///< by which picture, the last time
        asset::Texel cell{};     ///< the first one
        /// Where paints are solid, the colours beside pieces of the first pair, if no other pair but its
        /// reverse is.
        std::optional<asset::Texel> twoColors = std::nullopt;
        CellSets cells;
    };
    /// Squares of a level: [min, max), row by row.
    struct Region {
        int level;
        glm::i64vec2 min, max;
    };
    /// The asset is another one now, of which that changed. Returns the bytes of tiles that were sent.
    std::size_t update(const asset::Difference& difference, const PaintUpdate& paints);
    /// For one picture. Makes what is missing, on all processors. May move the texture.
    std::vector<const Placed*> prepare(const Region& region);
    /// A cell of the first grid, of whose cells in finer ones the first.
    const asset::Texel& cellAt(const Placed& tile, unsigned column, unsigned row) const;
    /// How a view's scale goes on from the one that was told last, if it comes near another level so.
    struct Zoom {
        int levels;    ///< 1 or -1
        double scale;  ///< that the picture will have there, by the view's
    };
    std::optional<Zoom> zoomTo(const asset::View& view);
    /// For pictures to come, after prepare(): begins to make what is missing on a thread of its own. A later
    /// prepare() takes it.
    void prepareAhead(const Region& region);
    /// Waits for that thread and drops what it made: before the asset changes.
    void stopAhead() { ahead_.reset(); }
    /// One that is crowded all over. May move the texture.
    const Placed& prepareCrowded();
    /// Whether tiles do not suffice for a view. They do where the scanner lacks the colours of materials.
    bool isScanned(const asset::View& view) const {
        return asset_->asset.materials.empty() && isStretched(view);
    }

    const asset::Map& map() const { return map_; }
    std::uint32_t firstPaint() const { return firstPaint_; }
    const TextureHandle& texture() const { return texture_; }
    ScannedPixels& scanned() { return scanned_; }

private:
    using Pieces = std::shared_ptr<const asset::PlanarIndex>;
    /// What tiles are made of. It does not change meanwhile.
    struct Work {
        const KeptAsset* asset;
        asset::Map map;
        std::uint32_t firstPaint, maxTurns;
        Pieces pieces;
        Pieces level;  ///< what tiles are cut from; null: to be made
        Region region;
        std::vector<TilePlace> places;
    };
    struct Made {
        Pieces level;
        std::vector<std::pair<TilePlace, Tile>> tiles;
    };
    static Made makeTiles(const Work& work);
    static Pieces lessDetailed(const Work& work);
    /// Of a region what is missing.
    Work workOn(const Region& region, std::span<Placed* const> tiles);
    void add(int level, Made made);
    /// Some of what was made ahead, so that no picture takes long; all of it if that is for this level.
    void addAhead(int level);
    Placed place(Tile tile);
    /// Copies what it keeps of its texels.
    void look(Placed& tile) const;
    /// Those of a region that are made, row by row, and null.
    std::vector<Placed*> find(const Region& region);
    std::span<const asset::Paint> paints() const {
        return std::span(asset_->asset.paints).subspan(firstPaint_);
    }
    void forget(std::span<const asset::Cell> squares);
    std::size_t recolorAll(const PaintUpdate& changed);
    void makeRoom();
    void upload();

    std::uint32_t number_;  ///< of the map
    asset::Map map_;
    const KeptAsset* asset_;
    std::uint32_t firstPaint_, maxTurns_;
    ScannedPixels scanned_;         ///< of crowded cells
    Pieces pieces_;                 ///< once a view has asked
    std::map<int, Pieces> levels_;  ///< with less detail; pieces_ where that has hardly fewer pieces

    std::map<TilePlace, Placed> placed_;
    std::uint64_t picture_ = 0;        ///< how many were prepared
    std::size_t texelsOfPicture_ = 0;  ///< that the last one used
    double lastRadius_ = 0;            ///< of a pixel, by zoomTo()
    std::optional<Placed> crowded_;
    std::vector<asset::Texel> texels_;
    std::size_t uploaded_ = 0, capacity_ = 0;
    TextureHandle texture_;

    /// A thread that makes tiles, whose end waits for it; then what it made and is not added yet.
    struct Ahead {
        int level;
        std::future<Made> thread;
        std::size_t perPicture = 0;
        Made made = {};
    };
    std::optional<Ahead> ahead_;
};

}  // namespace vtm::gl

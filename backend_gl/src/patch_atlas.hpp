/// \file
/// The patches of one map on the GPU, made when a view first needs them and kept for the views that follow.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/asset/view.hpp>
#include "backend_gl/src/gl.hpp"
#include "backend_gl/src/patch.hpp"
#include "backend_gl/src/scanned_pixels.hpp"

namespace vtm::gl {

/// The level of the patches for a view: their cells are at least `cellsPerRadius` footprints' radii wide and
/// less than twice that, so that what is made for one scale serves a whole octave.
int patchLevelFor(const asset::Map& map, const asset::View& view);
/// The largest of those radii, patch sides.
double patchMargin();

class PatchAtlas {
public:
    /// `asset` must outlive it. A cell that would take more than `maxTurns` is crowded.
    PatchAtlas(const KeptAsset& asset, const asset::Map& map, std::uint32_t maxTurns);

    /// What is kept of a Patch.
    struct Placed {
        bool flat = false;      ///< one paint, no texels
        bool programs = false;  ///< of its paints one is a program
        std::uint32_t paint = 0;
        std::uint32_t firstTexel = 0, firstCell = 0;
        std::vector<std::uint8_t> crowded;  ///< cells whose pixels are scanned
    };
    /// All squares of a level that meet [min, max], in patches, row by row. May move the texture.
    std::vector<const Placed*> prepare(int level, glm::i64vec2 min, glm::i64vec2 max);

    const asset::Map& map() const { return map_; }
    const TextureHandle& texture() const { return texture_; }
    ScannedPixels& scanned() { return scanned_; }

private:
    Placed place(const PatchPlace& place, std::span<const PlanarPiece* const> near);
    std::vector<std::vector<const PlanarPiece*>> piecesNear(int level, glm::i64vec2 min,
                                                            glm::i64vec2 max) const;
    void upload();

    asset::Map map_;
    const KeptAsset* asset_;
    std::uint32_t maxTurns_;
    ScannedPixels scanned_;                           ///< of crowded cells
    std::optional<std::vector<PlanarPiece>> pieces_;  ///< once a view has asked

    std::map<PatchPlace, Placed> placed_;
    std::vector<asset::Texel> texels_;
    std::size_t uploaded_ = 0, capacity_ = 0;
    TextureHandle texture_;
};

}  // namespace vtm::gl

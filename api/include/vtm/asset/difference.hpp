/// \file
/// What changes from one asset to the next: what was made of the first is brought up to date at the cost of
/// what changed, and only what looks different is drawn again.
#pragma once

#include <cstdint>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::asset {

/// A box of the picture, user units.
struct Area {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// What a map is of the asset before.
struct MapChange {
    static constexpr std::uint32_t isNew = 0xFFFFFFFF;
    std::uint32_t before = isNew;  ///< its number there; no two maps have the same
    std::vector<Cell> squares;     ///< whose subtrees changed; as Difference::squares
    bool paints = true;            ///< its paints changed, or their data, images or materials
};

/// Between two assets of one size that follow each other (compiler::Session::difference()).
struct Difference {
    bool everything = true;  ///< nothing can be taken over but images and `maps`
    /// Squares of the first map whose subtrees changed. The rest of the tree has the same leaves and pieces,
    /// with the same numbers of paints; records may stand elsewhere. Assets have one map then, and no
    /// instances.
    std::vector<Cell> squares;
    bool paints = true;  ///< paints or their data changed
    bool images = true;  ///< images or materials changed
    /// What may look different, also if nothing can be taken over. Nothing does outside; boxes may overlap.
    std::vector<Area> areas;
    int pixelsAround = 0;  ///< so many pixels around them may look different too: filters resample
    /// Of pictures with filters, where `everything` is set: by map of the next asset, what can be taken over
    /// all the same (asset::Evaluator::update). Empty: nothing.
    std::vector<MapChange> maps;
};

}  // namespace vtm::asset

/// \file
/// One update of a session: from what is kept of the last scene, and the next scene, to the next asset.
#pragma once

#include <optional>

#include <vtm/compiler/session.hpp>
#include "compiler/lower/lattice.hpp"
#include "compiler/lower/lower.hpp"
#include "compiler/lower/outline_cache.hpp"
#include "compiler/paint/region_paints.hpp"
#include "compiler/session/changes.hpp"
#include "compiler/tree/partition.hpp"

namespace vtm::compiler {

/// What is kept of the last scene.
struct Kept {
    /// Of no scene yet.
    Kept(const Excerpt& of, const Options& options);

    Excerpt excerpt;  ///< of all scenes
    Lattice lattice;
    OutlineCache cache;
    LoweredScene picture;
    LayerNames names;
    std::vector<LayerMeaning> meanings;  ///< by layer
    std::optional<Partition> partition;
    StackPaints paints;

    /// Whether so much has come or gone that it is better to begin anew.
    bool isWorn() const;
};

/// What an edit did, and what it changed.
struct Edited {
    Update update;
    asset::Difference difference;
};

/// Brings `kept` and `result` from the last scene to `scene`. Gives up and returns nothing if most outlines
/// are new, because compiling takes less, or if a pattern must be drawn as an image. If it does, or throws,
/// `kept` is of no use any more, and `result` is what it was.
std::optional<Edited> edit(Kept& kept, Result& result, const scene::Scene& scene, const Options& options);

}  // namespace vtm::compiler

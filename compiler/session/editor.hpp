/// \file
/// One update of a session: from what is kept of the last scene, and the next scene, to the next asset.
#pragma once

#include <optional>

#include <vtm/compiler/session.hpp>
#include "compiler/lower/lattice.hpp"
#include "compiler/lower/outline_cache.hpp"
#include "compiler/paint/region_paints.hpp"
#include "compiler/session/changes.hpp"
#include "compiler/tree/partition.hpp"

namespace vtm::compiler {

/// What is kept of the last scene.
struct Kept {
    /// Of no scene yet.
    Kept(double pictureWidth, double pictureHeight, const Options& options);

    double width, height;
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

/// Brings `kept` and `result` from the last scene to `scene`. If it throws, `kept` is of no use any more, and
/// `result` is what it was.
Update edit(Kept& kept, Result& result, const scene::Scene& scene, const Options& options);

}  // namespace vtm::compiler

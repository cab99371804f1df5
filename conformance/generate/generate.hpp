/// \file
/// Random scenes that are hard on a compiler, and the smallest scene that still fails.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <vtm/scene/scene.hpp>

namespace vtm::generate {

/// A valid scene of a few items, the same for a seed on every machine. Its outlines are polygons and curves
/// of all kinds, fills of both rules and strokes of every join, cap and dash: overlapping themselves and each
/// other, coincident, nearly coincident, tangent, with cusps, loops, segments of no length and many
/// rays at one vertex; cut by clips, in groups with opacity and blend modes, painted with colours and
/// gradients. Some reach far out of the picture.
scene::Scene randomScene(std::uint64_t seed);

/// Scenes of one kind of difficulty (src/hard/families.hpp has the list).
struct Family {
    const char* name;                          ///< lower case, with hyphens
    scene::Scene (*make)(std::uint64_t seed);  ///< valid, the same for a seed on every machine
};
std::span<const Family> hardFamilies();

/// A smaller scene for which `fails` still holds: parts are taken away and numbers made round as long as it
/// does. `fails(scene)` must hold and must not throw; it is called for valid scenes only, `trials` times at
/// most. The result is a local minimum if the trials suffice.
/// Source: Zeller, Hildebrandt 2002 (delta debugging), on the tree of a scene.
scene::Scene shrink(const scene::Scene& scene, const std::function<bool(const scene::Scene&)>& fails,
                    int trials = 2000);

}  // namespace vtm::generate

/// \file
/// Scenes made of bytes, for fuzzing what comes after the importer.
#pragma once

#include <cstdint>
#include <span>

#include <vtm/scene/scene.hpp>

namespace vtm::fuzz {

struct ByteScene {
    scene::Scene scene;  ///< valid
    /// Rounding changes it little, and the reference integrates it: it has no blend mode that jumps (dodge,
    /// burn, those that sort channels), no arc that reaches far, nothing that is further away than doubles
    /// resolve, and no pattern.
    bool isSteady = true;
};

/// A few items with every kind of path, stroke, paint, group, clip, mask and selection; the same for the same
/// bytes. Dashes and tiles are few.
ByteScene sceneOfBytes(std::span<const std::uint8_t> bytes);

}  // namespace vtm::fuzz

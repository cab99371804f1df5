/// \file
/// What of a mask is drawn: one instance for every square of its tree that can cover a part of a pixel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/programs.hpp"

namespace vtm::gl {

/// Vertex data of leaf_vertex.glsl.
struct Instance {
    std::uint32_t x = 0, y = 0;
    std::uint32_t levelAndMap = 0;  ///< level | map << 4
    std::uint32_t entry = 0;
};
/// 28 bits hold a map's index beside its level.
inline constexpr std::size_t maxMaps = std::size_t(1) << 28;

/// Instances [first, first + count).
struct Range {
    std::size_t first = 0, count = 0;
};

/// A map whose paint indices are 0 outside and 1 inside, as it is drawn.
struct DrawnMask {
    std::uint32_t map = 0;
    std::array<Range, leafProgramCount> ranges;
    /// Bounds of all instances, in squares of the deepest level.
    glm::uvec2 min{0}, max{0};
};

struct InstanceList {
    std::vector<Instance> instances;
    std::vector<DrawnMask> drawn;
    /// By map: its index in `drawn`.
    std::vector<std::optional<std::uint32_t>> drawnOfMap;
};

/// Of every mask that a command draws. Instances are in order of program, then of first use, so that masks
/// used one after another make one run of instances a program.
InstanceList makeInstances(const asset::AssetView& asset);

}  // namespace vtm::gl

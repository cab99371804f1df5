/// \file
/// What of a map is drawn: one instance for every square of its tree that can colour a pixel.
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

/// One map as it is drawn, with what its paint indices mean.
struct DrawnMap {
    std::uint32_t map = 0;
    bool coverage = false;  ///< indices are 0 and 1 and mean themselves
    std::array<Range, costClassCount> ranges;
    /// Bounds of all instances, in squares of the deepest level.
    glm::uvec2 min{0}, max{0};
};

struct InstanceList {
    std::vector<Instance> instances;
    std::vector<DrawnMap> drawn;
    /// By map: its index in `drawn`.
    std::vector<std::optional<std::uint32_t>> asColor, asCoverage;
};

/// Of every map that a command draws. Instances are in order of cost class, then of first use, so
/// that maps used one after another make one run of instances a class.
InstanceList makeInstances(const asset::AssetView& asset);

}  // namespace vtm::gl

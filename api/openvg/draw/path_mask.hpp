/// \file
/// Which pixels an outline covers, and how much: a planar map with two sides, inside and outside.
///
/// What is drawn once is covered without a map. When it is drawn again the map is compiled, in the path's own
/// space, and drawn under any matrix. The tolerance is a share of the outline's size, so where a view
/// magnifies it further than that allows, a finer one is made; beyond what can be proven there are no maps.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vtm/scene/path.hpp>
#include "api/openvg/image/pixels.hpp"
#include "raster/coverage.hpp"

namespace vtm::openvg {

using asset::CoverageRun;
/// Takes the covered runs of a row, surface coordinates.
using RowSink = std::function<void(int y, std::span<const CoverageRun>)>;

class PathMask {
public:
    PathMask(scene::Path outline, scene::FillRule rule);
    ~PathMask();

    const scene::Path& outline() const { return *outline_; }
    scene::FillRule rule() const { return rule_; }
    /// No other mask of the process has it, then or later.
    std::uint64_t id() const { return id_; }
    /// A box around what scan() may give.
    Rectangle bounds(const glm::mat3& toSurface, const Rectangle& clip) const;

    /// Exact coverage of the pixels of `clip` (section 6: pixel (x, y) is the square from there to (x + 1, y
    /// + 1)).
    void scan(const glm::mat3& toSurface, const Rectangle& clip, const RowSink& row);
    /// Coverage 1 where a pixel's centre is inside, 0 elsewhere. A border that two paths share bit for bit
    /// gives every centre to one of them: each segment is cut into the same lines whichever way it runs.
    void scanCenters(const glm::mat3& toSurface, const Rectangle& clip, const RowSink& row) const;

    /// What is seen through a matrix in perspective, or between clip lines (path/projective.hpp), in surface
    /// coordinates. The last one is kept.
    PathMask& seen(const glm::mat3& toSurface, const std::vector<glm::dvec3>& lines, const Rectangle& clip);

private:
    /// Of one matrix, clip lines and a clip.
    struct Seen;

    const asset::CoverageScanner& scannerFor(double tolerance);

    std::uint64_t id_;
    std::shared_ptr<const scene::Path> outline_;  ///< shared with the scenes that are compiled
    scene::FillRule rule_;
    glm::dvec2 min_{0}, max_{0};                                     ///< a box around the outline
    bool isScanned_ = false;                                         ///< it was drawn before
    std::array<std::optional<asset::CoverageScanner>, 5> scanners_;  ///< from coarse to fine
    std::unique_ptr<Seen> seen_;                                     ///< null at first
};

/// The pixels that the image of a box may meet, within `clip`. Empty for NaN.
Rectangle pixelsOf(const glm::mat3& toSurface, glm::dvec2 min, glm::dvec2 max, const Rectangle& clip);

}  // namespace vtm::openvg

/// \file
/// A map's boundaries as the scanner keeps them: by squares, so that it can pass over those that a view does
/// not show, draw some alone, and make those anew that changed.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/limits/limits.hpp>
#include "raster/map_part.hpp"
#include "raster/planar_map.hpp"
#include "raster/src/boundaries.hpp"
#include "raster/src/detail.hpp"

namespace vtm::asset {

/// Boundaries, and the box around them, lattice coordinates.
class BoundaryBox {
public:
    /// Without a square nothing is merged.
    explicit BoundaryBox(std::span<const PlanarPiece> pieces, std::optional<DetailSquare> square = {});

    bool empty() const { return boundaries_.empty(); }
    std::size_t size() const { return boundaries_.size(); }
    glm::dvec2 min() const { return min_; }
    glm::dvec2 max() const { return max_; }
    /// What to draw where a pixel is so many lattice steps: the boundaries, or fewer that look the same
    /// there. Made when first asked for.
    const Boundaries& at(double pixel) const;

private:
    Boundaries boundaries_;
    glm::dvec2 min_{0}, max_{0};
    double meanLength_ = 0;
    std::optional<DetailSquare> square_;
    DetailLevels levels_;
};

/// A map without what is placed in it.
class ScannedMap {
public:
    ScannedMap(const AssetView& asset, const Map& map);
    /// Of boundaries that somebody else made; they are one square.
    explicit ScannedMap(const PlanarMap& map);

    const MapPlace& place() const { return place_; }
    /// All boundaries, in boxes.
    std::size_t boxCount() const { return boxes_.size() + lines_.size(); }
    const BoundaryBox& box(std::size_t i) const {
        return i < boxes_.size() ? boxes_[i] : lines_[i - boxes_.size()].seams;
    }
    std::size_t boundaryCount() const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < boxCount(); ++i)
            count += box(i).size();
        return count;
    }

    /// Those of the picture that is the map's in the squares for which `isSeen(min, max)` says so of their
    /// boundaries' box, and transparent elsewhere: calls visit(boundaries) for those of each square and
    /// for those between squares, where a pixel is so many steps.
    template <class IsSeen, class Visit>
    void forEachOfSeen(double pixel, IsSeen&& isSeen, Visit&& visit) const {
        std::array<Borders, 2> borders;
        for (std::size_t i = 0; i < squares_.size(); ++i) {
            limits::check();
            if (isSeen(squares_[i].min, squares_[i].max)) {
                visit(boxes_[i].at(pixel));
                addBorders(squares_[i], borders);
            }
        }
        visit(Boundaries(seams(std::move(borders))));
    }

    /// Brings it to the map of another asset, whose tree is another one in these squares alone.
    void update(const AssetView& asset, const Map& map, std::span<const Cell> changed);

private:
    struct Square {
        Cell cell;
        std::array<Borders, 2> borders;
        glm::dvec2 min, max;  ///< of it and all boundaries in it
    };

    /// A line between squares: Stretch::line() as seen from above, and what stands along all of it.
    struct LineNumber {
        std::size_t direction;
        std::uint64_t number;

        auto operator<=>(const LineNumber&) const = default;
    };
    struct Line {
        LineNumber line;
        BoundaryBox seams;
    };

    void add(MapPart part);
    static void addLines(const Square& square, std::vector<LineNumber>& lines);
    void makeSeams(std::vector<LineNumber> lines);
    static void addBorders(const Square& square, std::array<Borders, 2>& borders);

    MapPlace place_;
    std::vector<Square> squares_;     ///< none where somebody else made the boundaries
    std::vector<BoundaryBox> boxes_;  ///< by square
    std::vector<Line> lines_;         ///< ascending
};

}  // namespace vtm::asset

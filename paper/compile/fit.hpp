/// \file
/// Paper mode: polylines to Hermite pieces in a cell's coordinates.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "paper/model.hpp"

namespace vtm::paper {

/// Slopes of fitted pieces: the arc turns by 22.5 degrees at most from its chord.
inline constexpr double largestSlope = 0.41421356237309503;  // tan(22.5 degrees)

/// One piece from the first of `points` to the last, within `tolerance` of the polyline; all in cell
/// coordinates. Its ends may coincide after rounding: then everything lies within `tolerance` of them.
std::optional<Piece> fitPiece(std::span<const glm::dvec2> points, double tolerance);

/// As few pieces as taking the longest possible each time needs; at most `limit` and one more.
/// Pieces without length are left out.
std::vector<Piece> fitPieces(std::span<const glm::dvec2> points, double tolerance, std::size_t limit);

}  // namespace vtm::paper

/// \file
/// Places of symbols: maps between their spaces and the picture's.
#pragma once

#include <glm/matrix.hpp>

#include <vtm/scene/affine.hpp>
#include "asset/instances.hpp"
#include "compiler/lower/outline.hpp"
#include "geometry/box.hpp"

namespace vtm::compiler {

inline asset::Affine2 affine2(const scene::Affine& m) { return {{m[0], m[1]}, m[2]}; }

inline scene::Affine affine(const asset::Affine2& m) { return {m.linear[0], m.linear[1], m.offset}; }

inline asset::Affine2 inverse(const asset::Affine2& m) {
    const glm::dmat2 linear = glm::inverse(m.linear);
    return {linear, -(linear * m.offset)};
}

inline double largestStretch(const asset::Affine2& m) { return compiler::largestStretch(affine(m)); }

/// By more than `slack` along both axes.
inline bool overlap(const geometry::Box& a, const geometry::Box& b, double slack) {
    const geometry::Box both = a.intersection(b);
    return both.width() > slack && both.height() > slack;
}

inline geometry::Box mapped(const asset::Affine2& m, const geometry::Box& box) {
    return geometry::mapped(box, affine(m));
}

/// The square of a map.
inline constexpr geometry::Box unitSquare{glm::dvec2(0), glm::dvec2(1)};

}  // namespace vtm::compiler

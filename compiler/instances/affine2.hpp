/// \file
/// Places of symbols: maps between their spaces and the picture's, and boxes.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <vtm/scene/path.hpp>
#include "asset/instances.hpp"
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

inline asset::Affine2 affine2(const scene::Affine& m) { return {{m[0], m[1]}, m[2]}; }

inline scene::Affine affine(const asset::Affine2& m) { return {m.linear[0], m.linear[1], m.offset}; }

inline asset::Affine2 inverse(const asset::Affine2& m) {
    const glm::dmat2 linear = glm::inverse(m.linear);
    return {linear, -(linear * m.offset)};
}

inline double largestStretch(const asset::Affine2& m) { return compiler::largestStretch(affine(m)); }

struct Box2 {
    glm::dvec2 min{HUGE_VAL}, max{-HUGE_VAL};

    void add(glm::dvec2 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const Box2& box) {
        add(box.min);
        add(box.max);
    }
    bool isWithin(glm::dvec2 low, glm::dvec2 high) const {
        return min.x >= low.x && min.y >= low.y && max.x <= high.x && max.y <= high.y;
    }
    /// By more than `slack` along both axes.
    bool overlaps(const Box2& b, double slack) const {
        return std::min(max.x, b.max.x) - std::max(min.x, b.min.x) > slack &&
               std::min(max.y, b.max.y) - std::max(min.y, b.min.y) > slack;
    }
};

/// Of the image of the box [min, max].
inline Box2 mapped(const asset::Affine2& m, glm::dvec2 min, glm::dvec2 max) {
    Box2 box;
    for (const glm::dvec2 p : {min, max, glm::dvec2(min.x, max.y), glm::dvec2(max.x, min.y)})
        box.add(m(p));
    return box;
}

}  // namespace vtm::compiler

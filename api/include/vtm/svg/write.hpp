/// \file
/// Scene in, SVG out.
#pragma once

#include <optional>
#include <string>

#include <vtm/error.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::svg {

/// A scene has a part that cannot be written. what() names the first such part.
class WriteError : public Error {
    using Error::Error;
};

struct WriteOptions {
    /// What the document shows, in the picture's units, not empty; by default all of the picture.
    std::optional<scene::Rect> part = {};
    /// Writes paths and images that occur several times once, where that is shorter, and a fill and the
    /// stroke of the same path in one element. Otherwise every item is an element of its own.
    bool shared = true;
};

/// Returns the scene as an SVG document in its units, y down: a `path` for an item, a `g` for a group, two
/// groups for a selection, PNG images; everything that elements refer to is in one `defs` at the start.
/// Colours are rounded to 8 bits a channel; other numbers are the shortest that read back as the same value.
/// What paints nothing is left out. So load() makes the same scene of it; a selection is drawn the same, too.
/// But load() leaves out, with warnings, what reaches further than 1e9 from the origin or is nested too deep
/// for it, and refuses documents of a width or height outside [2^-40, 1e9] (vtm/svg/load.hpp).
///
/// Throws WriteError for what SVG cannot say: materials, images with the bilinear filter, items that reach
/// beyond the image they are painted with, numbers beyond 1e30; and for scenes that are nested deeper than
/// Limits::maxDepth. Throws limits::Exceeded under a budget. The scene is valid (scene::validate).
std::string write(const scene::Scene& scene, const WriteOptions& options = {});

}  // namespace vtm::svg

#pragma GCC visibility pop

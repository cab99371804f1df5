/// \file
/// Scene in, SVG out: for scenes of plain paths.
#pragma once

#include <string>

#include <vtm/error.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::svg {

/// Names the first part of a scene that is not written.
class WriteError : public Error {
    using Error::Error;
};

/// A document of one `path` an item and one `g` a group, in the scene's units, y down. Fills, strokes,
/// opacities and solid colours (rounded to 8 bits a channel) are written; gradients, patterns, images, clips,
/// masks and blend modes are a WriteError. Coordinates are the shortest that read back as the same value. The
/// scene is valid.
std::string write(const scene::Scene& scene);

}  // namespace vtm::svg

#pragma GCC visibility pop

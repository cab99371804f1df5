/// \file
/// Scene in, SVG out: for scenes of plain paths.
#pragma once

#include <string>

#include <vtm/error.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm::svg {

/// A scene has a part that cannot be written. what() names the first such part.
class WriteError : public Error {
    using Error::Error;
};

/// Returns an SVG document with one `path` per item and one `g` per group, in the scene's units, y down. It
/// contains fills, strokes, opacities and solid colours, rounded to 8 bits per channel. Coordinates are
/// written with the fewest digits that read back as the same value. The scene must be valid
/// (scene::validate). Throws WriteError for gradients, patterns, images, materials, clips, masks, selections
/// and blend modes.
std::string write(const scene::Scene& scene);

}  // namespace vtm::svg

#pragma GCC visibility pop

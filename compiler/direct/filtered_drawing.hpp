/// \file
/// A scene with filters and one view of it in, pixels out: its pictures without filters are drawn from the
/// scene where the commands that filter and composite them need them (compiler/filters).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/raster/view.hpp>
#include "compiler/lower/lower.hpp"
#include "raster/command_picture.hpp"

namespace vtm::compiler {

struct FilteredDrawing {
    asset::CommandPicture picture;
    std::vector<std::string> warnings;

    /// Null where a part of it cannot be a PlainDrawing. The scene must be valid; Options::filterPixels
    /// counts as 0. Throws as compile() does, and std::length_error if the view is beyond its limits.
    static std::unique_ptr<const FilteredDrawing> make(const scene::Scene& scene, const Excerpt& excerpt,
                                                       const asset::View& view, Options options);
};

}  // namespace vtm::compiler

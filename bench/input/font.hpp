/// \file
/// A sheet of glyphs, through FreeType.
#pragma once

#include <optional>
#include <string>

#include <vtm/scene/scene.hpp>

namespace vtm::bench {

/// The printable glyphs of ASCII, each an item in a square of its own. `path` empty: a DejaVu Sans of the
/// system. Nothing, and why, if there is no font or no FreeType.
std::optional<scene::Scene> fontSheet(const std::string& path, std::string& why);

}  // namespace vtm::bench

/// \file
/// The `d` and `points` attributes. Source: SVG 2 sections 9.3 and 10.6.
#pragma once

#include <string_view>

#include <vtm/scene/path.hpp>

namespace vtm::svg {

/// What was read up to the first error, as SVG 2 section 9.5.4 asks for.
struct ParsedPath {
    scene::Path path;
    bool complete = true;       ///< false where an error ended it
    std::string_view unread{};  ///< from the error on; empty where the text ends too early
};

ParsedPath parsePathData(std::string_view text);
/// One open subpath; a last x without a y is left out.
ParsedPath parsePoints(std::string_view text);

/// The path data in CSS's `path("…")`; the text itself where it is none.
std::string_view pathFunctionData(std::string_view text);
/// Whether it is `path("…")` with complete path data.
bool isPathFunction(std::string_view text);

}  // namespace vtm::svg

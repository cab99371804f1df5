/// \file
/// The files of paper/gl/shaders as strings; the build writes the definitions.
#pragma once

#include <string_view>

namespace vtm::paper::shaders {

extern const std::string_view paper_hermite, paper_mask, paper_fragment, paper_pattern_fragment,
    paper_surface_vertex;

}  // namespace vtm::paper::shaders

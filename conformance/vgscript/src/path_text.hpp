/// \file
/// SVG's path data as OpenVG's.
#pragma once

#include <string>
#include <vector>

#include <VG/openvg.h>

namespace vtm::vgscript {

struct PathData {
    std::vector<VGubyte> segments;
    std::vector<VGfloat> coordinates;  ///< absolute
};

/// As the SVG importer reads it; empty where it reads nothing.
PathData pathData(const std::string& text);

}  // namespace vtm::vgscript

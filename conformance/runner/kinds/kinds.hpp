/// \file
/// The kinds of cases: what makes cases of a folder. A new kind is a function here and a line in kinds.cpp.
#pragma once

#include <vector>

#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {

/// By "kind" of the folder's settings; nothing where there is none. Throws what is wrong with them.
std::vector<Case> casesOf(const Folder& folder);

/// Every SVG file is a scene, drawn by engines under views and compared with the exact reference.
std::vector<Case> sceneCases(const Folder& folder);
/// SVG text against outlines that a script placed.
std::vector<Case> textCases(const Folder& folder);
/// A feature of SVG against the same picture written without it.
std::vector<Case> pairCases(const Folder& folder);
/// Every SVG file is a texture on a plane (docs/texture.md), compared with the exact reference.
std::vector<Case> textureCases(const Folder& folder);
/// Seeds of the generator (conformance/generate); what fails is shrunk.
std::vector<Case> randomCases(const Folder& folder);
/// Files that cannot be read, and files damaged on purpose.
std::vector<Case> robustnessCases(const Folder& folder);
/// Rows of the paper.
std::vector<Case> paperCases(const Folder& folder);
/// Real files against ground truth made elsewhere.
std::vector<Case> corpusCases(const Folder& folder);
/// Drawings that put very much into few pixels, made small.
std::vector<Case> crowdedCases(const Folder& folder);
/// Scripts of OpenVG calls (conformance/suites/openvg/README.md).
std::vector<Case> openvgCases(const Folder& folder);
/// The SVG test suite, drawn by the vtm command and judged by the suite's own scorer.
std::vector<Case> svgSuiteCases(const Folder& folder);

}  // namespace vtm::conformance

/// \file
/// A folder's SVG and .vtmtree files times its variants.
#pragma once

#include <functional>

#include <vtm/scene/scene.hpp>
#include "conformance/runner/suite/suite.hpp"

namespace vtm::conformance {

struct SvgCase {
    std::string name;
    std::filesystem::path file;
    std::string style;  ///< CSS for the element with the id `subject`
    Settings settings;

    /// Throws svg::ParseError, TreeError, and SuiteError where a style has no subject to apply to.
    scene::Scene scene() const;
};

using Runner = std::function<Outcome(const Setting&)>;

/// `make` gives what runs a case.
std::vector<Case> svgCases(const Folder& folder, const std::function<Runner(const SvgCase&)>& make);

}  // namespace vtm::conformance

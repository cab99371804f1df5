/// \file
/// Which suites see which mistake.
#pragma once

#include <string>
#include <vector>

#include "conformance/runner/suite/case.hpp"

namespace vtm::conformance {

/// Runs the cases once for each fault ("every": all of them) and prints a table: of the cases of each suite,
/// how many fail. Whether each fault is seen by some case.
bool surveyFaults(const std::vector<Case>& cases, const std::vector<std::string>& faults, Setting setting,
                  unsigned jobs);

}  // namespace vtm::conformance

/// \file
/// Rows as JSON: for the JSON file and for the page.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "conformance/runner/run.hpp"

namespace vtm::conformance {

nlohmann::ordered_json rowJson(const Row& row);
nlohmann::ordered_json summaryJson(const Summary& summary);
void writeText(const std::filesystem::path& file, const std::string& text);

}  // namespace vtm::conformance

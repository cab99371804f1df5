/// \file
/// Results as a Markdown table and as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace vtm::bench {

using Json = nlohmann::ordered_json;

/// What a subcommand found out.
struct Report {
    std::string name;   ///< of its files
    std::string title;  ///< in the Markdown
    std::string text;   ///< what the figures mean, one paragraph
    /// A row an object, all with the same keys; numbers are rounded in Markdown only.
    Json rows = Json::array();
    Json summary = Json::array();    ///< shown in the Markdown instead, unless empty
    std::vector<std::string> notes;  ///< what was missing or did not work
    double seconds = 0;              ///< wall time that the report took
    bool quick = false;              ///< Options::quick
};

/// Writes name.json, with what it was measured on, and name.md into the folder, which is made; the Markdown
/// goes to stdout too.
void write(const Report& report, const std::filesystem::path& folder);

}  // namespace vtm::bench

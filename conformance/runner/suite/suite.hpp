/// \file
/// Suites: folders of case files and of suite.json files, which say how the files below them become cases.
/// docs/testing.md has the format.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "conformance/runner/suite/case.hpp"

namespace vtm::conformance {

/// A suite.json, or what a user of it wants, is wrong; names the file and the cause.
class SuiteError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

using Settings = nlohmann::ordered_json;

/// What the cases of a folder or a variant are made with: a suite.json over those of the folders above it
/// (RFC 7386: a member replaces the one above, objects are merged, null takes away).
struct Folder {
    std::filesystem::path path;
    std::string name;  ///< dotted, from the suite down
    Settings settings;
};

/// A variant of a file: part of the name, and what it changes.
struct Variant {
    std::string name;   ///< dotted; empty: the file as it is
    std::string style;  ///< CSS declarations for the element with the id `subject`
    Settings settings;  ///< merged over the folder's
};
/// "variants" is a list of sets, a set a list of axes, an axis an object whose members are values: a text is
/// CSS, an object settings. A set gives the product of its axes; without sets there is one variant, the file
/// itself.
std::vector<Variant> variantsOf(const Settings& settings);

/// How many of a folder's cases there are: those for every day, or with the settings' member "full" merged
/// over them.
enum class Extent { Daily, Full };

/// All folders with a suite.json, the root first, by name.
std::vector<Folder> foldersOf(const std::filesystem::path& suite, Extent extent = Extent::Daily);

/// A text's first comment in SVG, or the lines of // that it begins with: what the file is about. SuiteError
/// without one.
std::string aboutOf(const std::filesystem::path& file, const std::string& text);

/// The cases of a suite's folder, of all kinds.
std::vector<Case> loadSuite(const std::filesystem::path& suite, Extent extent = Extent::Daily);
/// Those of every folder in `suites`, by suite.
std::vector<Case> loadSuites(const std::filesystem::path& suites, Extent extent = Extent::Daily);

std::string readText(const std::filesystem::path& file);

}  // namespace vtm::conformance

#include "conformance/runner/suite/suite.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include <fmt/core.h>

#include <vtm/image/codec.hpp>
#include "conformance/runner/kinds/kinds.hpp"

namespace vtm::conformance {
namespace fs = std::filesystem;

namespace {

constexpr const char* settingsFile = "suite.json";

std::vector<fs::path> sorted(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        paths.push_back(entry.path());
    std::ranges::sort(paths);
    return paths;
}

Settings readSettings(const fs::path& file) {
    try {
        return Settings::parse(readText(file), nullptr, true, true);
    } catch (const nlohmann::json::exception& error) {
        throw SuiteError(file.string() + ": " + error.what());
    }
}

/// Depth first, so that folders come in the order of their names.
void collect(const fs::path& path, const std::string& name, Settings settings, std::vector<Folder>& folders) {
    if (fs::exists(path / settingsFile))
        settings.merge_patch(readSettings(path / settingsFile));
    folders.push_back({path, name, settings});
    for (const fs::path& child : sorted(path))
        if (fs::is_directory(child))
            collect(child, name + "." + child.filename().string(), settings, folders);
}

Variant joined(const Variant& a, const std::string& name, const Settings& value) {
    Variant both = a;
    both.name += (a.name.empty() ? "" : ".") + name;
    if (value.is_string())
        both.style += value.get<std::string>() + ";";
    else
        both.settings.merge_patch(value);
    return both;
}

}  // namespace

std::string readText(const fs::path& file) {
    const std::vector<std::uint8_t> bytes = image::readFile(file.string());
    return {bytes.begin(), bytes.end()};
}

std::vector<Variant> variantsOf(const Settings& settings) {
    const Variant plain{"", "", Settings::object()};
    if (!settings.contains("variants"))
        return {plain};
    std::vector<Variant> all;
    for (const Settings& set : settings.at("variants")) {
        std::vector<Variant> product{plain};
        for (const Settings& axis : set) {
            std::vector<Variant> longer;
            for (const Variant& variant : product)
                for (const auto& [name, value] : axis.items())
                    longer.push_back(joined(variant, name, value));
            product = std::move(longer);
        }
        all.insert(all.end(), product.begin(), product.end());
    }
    return all;
}

std::vector<Folder> foldersOf(const fs::path& suite, Extent extent) {
    std::vector<Folder> folders;
    collect(suite, suite.filename().string(), Settings::object(), folders);
    if (extent == Extent::Full)
        for (Folder& folder : folders)
            folder.settings.merge_patch(folder.settings.value("full", Settings::object()));
    return folders;
}

namespace {

/// The first in SVG, or the lines of // that a text begins with.
std::optional<std::string> firstComment(const std::string& text) {
    std::string lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line) && line.starts_with("//");)
        lines += line.substr(2) + "\n";
    if (!lines.empty())
        return lines;
    const std::size_t from = text.find("<!--"), to = text.find("-->", from);
    if (from == std::string::npos || to == std::string::npos)
        return std::nullopt;
    return text.substr(from + 4, to - from - 4);
}

}  // namespace

std::string aboutOf(const fs::path& file, const std::string& text) {
    const std::optional<std::string> comment = firstComment(text);
    if (!comment)
        throw SuiteError(file.string() + ": has no comment that says what it includes and excludes");
    std::string about;
    for (const char c : *comment) {
        const bool space = c == ' ' || c == '\n' || c == '\t' || c == '\r';
        if (!space)
            about += c;
        else if (!about.empty() && about.back() != ' ')
            about += ' ';
    }
    while (!about.empty() && about.back() == ' ')
        about.pop_back();
    return about;
}

std::vector<Case> loadSuite(const fs::path& suite, Extent extent) {
    std::vector<Case> cases;
    for (const Folder& folder : foldersOf(suite, extent)) {
        try {
            const std::vector<Case> more = casesOf(folder);
            cases.insert(cases.end(), more.begin(), more.end());
        } catch (const std::exception& error) {
            throw SuiteError(folder.path.string() + ": " + error.what());
        }
    }
    std::vector<std::string> names;
    for (const Case& one : cases)
        names.push_back(one.name);
    std::ranges::sort(names);
    if (const auto twice = std::ranges::adjacent_find(names); twice != names.end())
        throw SuiteError(suite.string() + ": two cases are called " + *twice);
    return cases;
}

std::vector<Case> loadSuites(const fs::path& suites, Extent extent) {
    std::vector<Case> cases;
    for (const fs::path& suite : sorted(suites))
        if (fs::is_directory(suite)) {
            const std::vector<Case> more = loadSuite(suite, extent);
            cases.insert(cases.end(), more.begin(), more.end());
        }
    return cases;
}

}  // namespace vtm::conformance

// Files that cannot be read, and files damaged on purpose: a picture, or an error that names place and cause.

#include <algorithm>
#include <random>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/compile.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/svg/load.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/generate/damage.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/suite/views.hpp"

namespace vtm::conformance {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

constexpr int rasterSide = 64;

void draw(const asset::Asset& asset) {
    asset::evaluate(
        asset, {rasterSide, rasterSide, {rasterSide / asset.width, 0, 0, rasterSide / asset.height, 0, 0}});
}

/// "picture", "picture with warning: ..." or "error: ...". Exceptions that are not documented go through.
std::string becomesOf(const std::string& file, const Bytes& bytes) {
    try {
        if (file.ends_with(".vtm")) {
            draw(asset::read(bytes));
            return "picture";
        }
        if (file.ends_with(".png")) {
            image::decode(bytes);
            return "picture";
        }
        svg::Options options;
        options.fileName = file;
        const svg::Document document = svg::load(bytes, options);
        const compiler::Result result = compiler::compile(document.scene);
        draw(result.asset);
        if (document.warnings.empty())
            return result.warnings.empty() ? "picture"
                                           : fmt::format("warning: {}:{}", file, result.warnings.front());
        const svg::Warning& first = document.warnings.front();
        return fmt::format("warning: {}:{}:{}: {}", first.where.file, first.where.line, first.where.column,
                           first.message);
    } catch (const svg::ParseError& error) {
        return fmt::format("error: {}", error.what());
    } catch (const asset::FormatError& error) {
        return fmt::format("error: {}: {}", file, error.what());
    } catch (const image::CodecError& error) {
        return fmt::format("error: {}: {}", file, error.what());
    } catch (const compiler::LimitError& error) {
        return fmt::format("error: {}: {}", file, error.what());
    }
}

/// FILE.expect beside a file: lines that begin with # say what it is about, the one other what becomes of it.
struct Expected {
    std::string about, outcome;
};

Expected readExpected(const fs::path& file) {
    Expected expected;
    std::istringstream text(readText(file.string() + ".expect"));
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("#"))
            expected.about +=
                (expected.about.empty() ? "" : " ") + line.substr(std::min<std::size_t>(2, line.size()));
        else if (!line.empty())
            expected.outcome = line;
    if (expected.about.empty() || expected.outcome.empty())
        throw SuiteError(file.string() +
                         ".expect: a line of # and one of what becomes of the file are wanted");
    return expected;
}

Outcome runFile(const fs::path& file, const std::string& wanted) {
    const std::string got = becomesOf(file.filename().string(), image::readFile(file.string()));
    return got == wanted ? Outcome::passed() : Outcome::failed("'" + got + "' instead of '" + wanted + "'");
}

// ---- Files damaged on purpose -------------------------------------------------------------------

bool namesItself(const std::string& got, const std::string& file) {
    return got == "picture" || got.starts_with("error: " + file + ":") ||
           got.starts_with("warning: " + file + ":");
}

/// `damage(whole, i)` for i = 0, 1, ... while it gives something.
Outcome runDamaged(const std::string& file, const Bytes& whole, std::size_t count,
                   const std::function<Bytes(std::size_t)>& damage) {
    if (becomesOf(file, whole).starts_with("error"))
        return Outcome::failed("the undamaged file is refused: " + becomesOf(file, whole));
    for (std::size_t i = 0; i < count; ++i)
        try {
            const std::string got = becomesOf(file, damage(i));
            if (!namesItself(got, file))
                return Outcome::failed(fmt::format("damage {}: '{}' does not name the file", i, got));
        } catch (const std::exception& error) {
            return Outcome::failed(fmt::format("damage {}: not a documented error: {}", i, error.what()));
        }
    return Outcome::passed();
}

/// A picture of the examples, as SVG or as the asset's file.
Bytes wholeFile(const std::string& name) {
    const fs::path drawing = cases::examplesDirectory() / (fs::path(name).stem().string() + ".svg");
    if (name.ends_with(".svg"))
        return image::readFile(drawing.string());
    return asset::write(compiler::compile(cases::loadScene(drawing)).asset);
}

void addDamaged(const Folder& folder, std::vector<Case>& cases) {
    const Settings& settings = folder.settings;
    const std::string json = (folder.path / "suite.json").string();
    const std::size_t cuts = settings.value("truncations", std::size_t(0)),
                      each = settings.value("corruptions", std::size_t(0)),
                      seeds = settings.value("seeds", std::size_t(0));
    for (const auto& file : settings.value("damaged", Settings::array())) {
        const auto name = file.get<std::string>();
        std::string dotted = name;
        std::ranges::replace(dotted, '.', '_');
        cases.push_back({fmt::format("{}.truncated.{}", folder.name, dotted), json,
                         "A file cut off in many places.", [=](const Setting&) {
                             const Bytes whole = wholeFile(name);
                             return runDamaged(name, whole, cuts, [&](std::size_t i) {
                                 return Bytes(whole.begin(),
                                              whole.begin() + std::ptrdiff_t(whole.size() * i / cuts));
                             });
                         }});
        for (std::size_t seed = 0; seed < seeds; ++seed)
            cases.push_back({fmt::format("{}.corrupted.{}.seed{:02}", folder.name, dotted, seed), json,
                             "A file with bytes overwritten, doubled, lost.", [=](const Setting&) {
                                 const Bytes whole = wholeFile(name);
                                 std::mt19937_64 random(seedOf(name) + seed);
                                 return runDamaged(name, whole, each, [&](std::size_t) {
                                     return generate::damaged(whole, random);
                                 });
                             }});
    }
}

}  // namespace

std::vector<Case> robustnessCases(const Folder& folder) {
    std::vector<Case> cases;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path))
        if (entry.path().extension() == ".expect")
            files.push_back(fs::path(entry.path()).replace_extension());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        const Expected expected = readExpected(file);
        cases.push_back({folder.name + "." + file.stem().string(), file.string(), expected.about,
                         [=](const Setting&) { return runFile(file, expected.outcome); }});
    }
    addDamaged(folder, cases);
    return cases;
}

}  // namespace vtm::conformance

// Scripts of OpenVG calls, against what they compare themselves and the picture beside them.

#include <algorithm>

#include <vtm/svg/load.hpp>
#include "conformance/reference/reference.hpp"
#include "conformance/runner/judge/judge.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/vgscript/vgscript.hpp"

namespace vtm::conformance {
namespace {

namespace fs = std::filesystem;

constexpr const char* engineName = "openvg";
constexpr std::string_view referenceSuffix = ".ref.vg";

vgscript::Outcome play(const fs::path& script) {
    return vgscript::play(readText(script), script.filename().string());
}

/// The lines of # that a script begins with.
std::string aboutOfScript(const fs::path& script) {
    std::istringstream text(readText(script));
    std::string about;
    for (std::string line; std::getline(text, line) && line.starts_with("# ");)
        about += (about.empty() ? "" : " ") + line.substr(2);
    if (about.empty())
        throw SuiteError(script.string() + ": begins without lines of # that say what it is about");
    return about;
}

image::Raster drawnByReference(const fs::path& file, const image::Raster& size) {
    const std::string text = readText(file);
    svg::Options options;
    options.fileName = file.string();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    // Layer by layer, as OpenVG draws.
    reference::Options layers;
    layers.mode = reference::Mode::Compat;
    return reference::render(svg::load({bytes, text.size()}, options).scene,
                             {size.width, size.height, scene::identity}, layers);
}

/// Nothing: the script is all there is.
std::optional<image::Raster> expectedPicture(const fs::path& script, const image::Raster& drawn) {
    const fs::path picture = fs::path(script).replace_extension(".svg");
    const fs::path calls = fs::path(script).replace_extension(referenceSuffix);
    if (fs::exists(picture))
        return drawnByReference(picture, drawn);
    if (!fs::exists(calls))
        return std::nullopt;
    vgscript::Outcome other = play(calls);
    if (!other.failures.empty())
        throw SuiteError(other.failures.front());
    return std::move(other.picture);
}

Outcome runScript(const fs::path& script, const Setting& setting) {
    if (std::ranges::find(setting.engines, Engine::Scan) == setting.engines.end())
        return Outcome::skipped("OpenVG draws by the engine scan, which is not asked for");
    const vgscript::Outcome played = play(script);
    if (!played.failures.empty()) {
        std::string all;
        for (const std::string& failure : played.failures)
            all += (all.empty() ? "" : "; ") + failure;
        return Outcome::failed(all);
    }
    const std::optional<image::Raster> expected = expectedPicture(script, played.picture);
    if (!expected)
        return Outcome::passed();
    if (std::ranges::all_of(expected->rgba, [](float channel) { return channel == 0; }))
        throw SuiteError(script.string() + ": the expected picture is blank");
    Bounds bounds;
    bounds.max = played.bound;
    Figure figure = measure(*expected, played.picture, bounds);
    figure.engine = engineName;
    Outcome outcome;
    if (!figure.broken.empty())
        outcome = Outcome::failed(figure.broken);
    if (!figure.broken.empty() || setting.keepPictures)
        outcome.pictures = Pictures{engineName, "", *expected, played.picture};
    outcome.figures.push_back(std::move(figure));
    return outcome;
}

}  // namespace

std::vector<Case> openvgCases(const Folder& folder) {
    std::vector<fs::path> scripts;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path)) {
        const std::string name = entry.path().filename().string();
        if (name.ends_with(".vg") && !name.ends_with(referenceSuffix))
            scripts.push_back(entry.path());
    }
    std::ranges::sort(scripts);
    std::vector<Case> cases;
    for (const fs::path& script : scripts)
        cases.push_back({folder.name + "." + script.stem().string(), script.string(), aboutOfScript(script),
                         [=](const Setting& setting) { return runScript(script, setting); }});
    return cases;
}

}  // namespace vtm::conformance

// Scenes of the generator, a case a seed. One that fails is shrunk while it fails and printed.

#include <fmt/core.h>

#include <vtm/svg/write.hpp>
#include "conformance/generate/generate.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"

namespace vtm::conformance {
namespace {

/// Trials of the shrinking, each of which draws every view.
constexpr int trials = 300;

Outcome look(const scene::Scene& scene, const SceneSettings& settings, const std::string& salt,
             const Setting& setting) {
    SceneSubject subject(scene, settings, viewsOf(settings.views, scene, salt), setting.fault);
    return judge(subject, setting);
}

/// As SVG where that can say it, else as the scene's text.
std::string asText(const scene::Scene& scene) {
    try {
        return svg::write(scene);
    } catch (const svg::WriteError&) {
        return scene::dump(scene);
    }
}

bool failsStill(const scene::Scene& scene, const SceneSettings& settings, const std::string& salt,
                const Setting& setting) {
    try {
        return look(scene, settings, salt, setting).status == Outcome::Status::Failed;
    } catch (const std::exception&) {
        return true;
    }
}

Outcome run(const scene::Scene& scene, const std::string& salt, const SceneSettings& settings,
            const Setting& setting) {
    Outcome outcome;
    try {
        outcome = look(scene, settings, salt, setting);
    } catch (const std::exception& error) {
        outcome = Outcome::failed(std::string("threw: ") + error.what());
    }
    if (outcome.status != Outcome::Status::Failed || setting.fault != Fault::None || !setting.shrink)
        return outcome;
    const scene::Scene small = generate::shrink(
        scene, [&](const scene::Scene& s) { return failsStill(s, settings, salt, setting); }, trials);
    outcome.message += "\nthe smallest scene that fails:\n" + asText(small);
    return outcome;
}

/// Who makes a scene of a seed. `name` stands in the case's name and in the views' salt; it is empty for the
/// plain generator.
struct Source {
    std::string name, about;
    scene::Scene (*make)(std::uint64_t seed);
};

std::vector<Source> sources(const Settings& settings) {
    if (!settings.value("hard", false))
        return {{"", "A scene of the generator.", generate::randomScene}};
    std::vector<Source> all;
    for (const generate::Family& family : generate::hardFamilies())
        all.push_back(
            {std::string(family.name) + ".", fmt::format("A hard scene: {}.", family.name), family.make});
    return all;
}

}  // namespace

std::vector<Case> randomCases(const Folder& folder) {
    const SceneSettings settings = sceneSettings(folder.settings);
    const auto from = folder.settings.at("from").get<std::uint64_t>(),
               count = folder.settings.at("count").get<std::uint64_t>();
    std::vector<Case> cases;
    for (const Source& source : sources(folder.settings))
        for (std::uint64_t seed = from; seed < from + count; ++seed)
            cases.push_back(
                {fmt::format("{}.{}seed{:04}", folder.name, source.name, seed),
                 (folder.path / "suite.json").string(), source.about, [=](const Setting& setting) {
                     return run(source.make(seed), source.name + std::to_string(seed), settings, setting);
                 }});
    return cases;
}

}  // namespace vtm::conformance

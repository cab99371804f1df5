// Drawings that put very much into few pixels, made small: where shaders run out of what a driver allows.

#include <fmt/core.h>

#include <vtm/svg/load.hpp>
#include "conformance/runner/kinds/crowded_scenes.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"

namespace vtm::conformance {
namespace {

Outcome run(const CrowdedScene& crowded, SceneSettings settings, int size, const Setting& setting) {
    const std::string text = crowded.svg();
    const scene::Scene scene =
        svg::load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).scene;
    settings.views.way = ViewPlan::Way::Whole;
    settings.views.raster = size;
    // Of very many curves in a pixel the evaluator's chords are no yardstick for the others.
    if (!crowded.varies)
        settings.bounds.twin = Bounds::any;
    SceneSubject subject(scene, settings, viewsOf(settings.views, scene, ""), setting.fault);
    return judge(subject, setting);
}

}  // namespace

std::vector<Case> crowdedCases(const Folder& folder) {
    const SceneSettings settings = sceneSettings(folder.settings);
    std::vector<Case> cases;
    for (const CrowdedScene& crowded : crowdedScenes())
        for (const int size : folder.settings.at("sizes").get<std::vector<int>>())
            cases.push_back({fmt::format("{}.{}.{}px", folder.name, crowded.name, size),
                             (folder.path / "suite.json").string(), crowded.about,
                             [=](const Setting& setting) { return run(crowded, settings, size, setting); }});
    return cases;
}

}  // namespace vtm::conformance

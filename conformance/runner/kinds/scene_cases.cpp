// SVG files as cases: each file times the variants of its folder.

#include <algorithm>

#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"
#include "conformance/runner/kinds/svg_files.hpp"

namespace vtm::conformance {
namespace {

Outcome run(const SvgCase& made, const Setting& setting) {
    const SceneSettings settings = sceneSettings(made.settings);
    const scene::Scene scene = made.scene();
    SceneSubject subject(scene, settings, viewsOf(settings.views, scene, made.name), setting.fault);
    return judge(subject, setting);
}

}  // namespace

std::vector<Case> sceneCases(const Folder& folder) {
    return svgCases(folder, [](const SvgCase& made) {
        sceneSettings(made.settings);  // what is wrong with them is said before anything runs
        return [made](const Setting& setting) { return run(made, setting); };
    });
}

}  // namespace vtm::conformance

// SVG text as cases: NAME.svg holds text, NAME.paths.svg the same picture as outlines that a script placed
// (conformance/suites/svg_text/make). Fonts are those of the suite's folder `fonts` and no others.

#include <algorithm>

#include <vtm/svg/load.hpp>
#include "conformance/reference/reference.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"

namespace vtm::conformance {
namespace {

namespace fs = std::filesystem;

constexpr const char* pathsSuffix = ".paths";

/// The bound on the text's exact picture. It is reached round a circle: arcs that text follows are cubics
/// within 4.3e-6 of their radius, and the lengths of all before a glyph add up.
constexpr Bounds placed{.max = 1};

/// The folder `fonts` beside or above a folder.
fs::path fontsOf(fs::path folder) {
    while (!fs::exists(folder / "fonts")) {
        if (folder == folder.root_path())
            throw SuiteError("there is no folder 'fonts'");
        folder = folder.parent_path();
    }
    return folder / "fonts";
}

scene::Scene sceneOf(const fs::path& file) {
    const std::string text = readText(file);
    const std::string fonts = fontsOf(file.parent_path()).string();
    svg::Options options;
    options.fileName = file.string();
    options.resourceDirectory = file.parent_path().string();
    options.fonts.directories = {fonts};
    options.fonts.systemFonts = false;
    options.fonts.serifFamily = "VTM Cubic", options.fonts.sansSerifFamily = "VTM Test";
    options.fonts.defaultFamily = "VTM Test";
    return svg::load({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, options).scene;
}

/// The text, drawn by every engine, against the exact picture of the outlines.
class TextSubject : public SceneSubject {
public:
    TextSubject(const fs::path& text, const scene::Scene& outlines, const SceneSettings& settings,
                const std::vector<LabelledView>& views, Fault fault)
        : SceneSubject(sceneOf(text), settings, views, fault), outlines_(outlines), views_(views) {}

    Bounds bounds(Engine engine) const override {
        return engine == Engine::Reference ? placed : SceneSubject::bounds(engine);
    }
    image::Raster expected(std::size_t view) override { return exact(outlines_, view); }
    image::Raster drawn(std::size_t view, Engine engine) override {
        return engine == Engine::Reference ? SceneSubject::expected(view) : SceneSubject::drawn(view, engine);
    }

private:
    image::Raster exact(const scene::Scene& scene, std::size_t view) const {
        const asset::View& v = views_[view].view;
        return reference::render(scene, {v.width, v.height, v.toPixels});
    }

    scene::Scene outlines_;
    std::vector<LabelledView> views_;
};

fs::path outlinesOf(const fs::path& text) {
    return text.parent_path() / (text.stem().string() + pathsSuffix + ".svg");
}

Outcome run(const fs::path& text, const SceneSettings& settings, const Setting& setting) {
    const scene::Scene outlines = sceneOf(outlinesOf(text));
    TextSubject subject(text, outlines, settings, viewsOf(settings.views, outlines, ""), setting.fault);
    return judge(subject, setting);
}

std::vector<fs::path> textsIn(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".svg" && entry.path().stem().extension() != pathsSuffix)
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::vector<Case> textCases(const Folder& folder) {
    const SceneSettings settings = sceneSettings(folder.settings);
    std::vector<Case> cases;
    for (const fs::path& text : textsIn(folder.path))
        cases.push_back({folder.name + "." + text.stem().string(), text.string(),
                         aboutOf(text, readText(text)),
                         [=](const Setting& setting) { return run(text, settings, setting); }});
    return cases;
}

}  // namespace vtm::conformance

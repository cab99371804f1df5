// Pairs as cases: NAME.svg uses a feature, the file beside it draws the same picture without. Of text that is
// NAME.paths.svg, outlines that a script placed (conformance/suites/svg_text/make); of all else
// NAME.plain.svg, written by hand from the specifications. Fonts are those of a folder `fonts` and no others.

#include <algorithm>

#include <vtm/svg/load.hpp>
#include "conformance/reference/reference.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"

namespace vtm::conformance {
namespace {

namespace fs = std::filesystem;

struct PairKind {
    const char* suffix;  ///< of the file without the feature
    bool hasFonts;
};
constexpr PairKind text{".paths", true}, plain{".plain", false};

/// The bound on the exact pictures of both. Text reaches it round a circle: arcs that text follows are cubics
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

scene::Scene sceneOf(const fs::path& file, const PairKind& kind) {
    const std::string content = readText(file);
    svg::Options options;
    options.fileName = file.string();
    options.resourceDirectory = file.parent_path().string();
    options.fonts.systemFonts = false;
    if (kind.hasFonts) {
        options.fonts.directories = {fontsOf(file.parent_path()).string()};
        options.fonts.serifFamily = "VTM Cubic", options.fonts.sansSerifFamily = "VTM Test";
        options.fonts.defaultFamily = "VTM Test";
    }
    return svg::load({reinterpret_cast<const std::uint8_t*>(content.data()), content.size()}, options).scene;
}

/// The one with the feature, drawn by every engine, against the exact picture of the one without.
class PairSubject : public SceneSubject {
public:
    PairSubject(const scene::Scene& with, const scene::Scene& without, const SceneSettings& settings,
                const std::vector<LabelledView>& views, Fault fault)
        : SceneSubject(with, settings, views, fault), without_(without), views_(views) {}

    Bounds bounds(Engine engine) const override {
        return engine == Engine::Reference ? placed : SceneSubject::bounds(engine);
    }
    image::Raster expected(std::size_t view) override {
        const asset::View& v = views_[view].view;
        return reference::render(without_, {v.width, v.height, v.toPixels});
    }
    image::Raster drawn(std::size_t view, Engine engine) override {
        return engine == Engine::Reference ? SceneSubject::expected(view) : SceneSubject::drawn(view, engine);
    }

private:
    scene::Scene without_;
    std::vector<LabelledView> views_;
};

fs::path partnerOf(const fs::path& file, const PairKind& kind) {
    return file.parent_path() / (file.stem().string() + kind.suffix + ".svg");
}

Outcome run(const fs::path& file, const PairKind& kind, const SceneSettings& settings,
            const Setting& setting) {
    const scene::Scene without = sceneOf(partnerOf(file, kind), kind);
    PairSubject subject(sceneOf(file, kind), without, settings, viewsOf(settings.views, without, ""),
                        setting.fault);
    return judge(subject, setting);
}

/// Those that have a partner; others are what they refer to.
std::vector<fs::path> filesIn(const fs::path& folder, const PairKind& kind) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".svg" && fs::exists(partnerOf(entry.path(), kind)))
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<Case> casesOf(const Folder& folder, const PairKind& kind) {
    const SceneSettings settings = sceneSettings(folder.settings);
    std::vector<Case> cases;
    for (const fs::path& file : filesIn(folder.path, kind))
        cases.push_back({folder.name + "." + file.stem().string(), file.string(),
                         aboutOf(file, readText(file)),
                         [=](const Setting& setting) { return run(file, kind, settings, setting); }});
    return cases;
}

}  // namespace

std::vector<Case> textCases(const Folder& folder) { return casesOf(folder, text); }
std::vector<Case> pairCases(const Folder& folder) { return casesOf(folder, plain); }

}  // namespace vtm::conformance

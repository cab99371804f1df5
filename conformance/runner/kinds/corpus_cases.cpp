// Real files: against ground truth that other engines made, and the engines against the reference.

#include <algorithm>

#include <fmt/core.h>

#include <vtm/raster/evaluate.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/reference/reference.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"

namespace vtm::conformance {
namespace {

namespace fs = std::filesystem;
using cases::CorpusFile;

std::string absent() {
    const fs::path corpus = cases::sharedDirectory() / "corpus";
    return fs::exists(corpus) ? std::string() : corpus.string() + " is absent";
}

/// A file against its ground truth: what PNG files would hold, as the truth does.
class TruthSubject : public SceneSubject {
public:
    TruthSubject(const scene::Scene& scene, const SceneSettings& settings, image::Raster truth, Bounds bounds,
                 Fault fault)
        : SceneSubject(scene, settings, viewsOf(settings.views, scene, ""), fault),
          truth_(std::move(truth)),
          bounds_(bounds) {}

    Bounds bounds(Engine) const override { return bounds_; }
    image::Raster expected(std::size_t) override { return truth_; }
    image::Raster drawn(std::size_t view, Engine engine) override {
        return cases::asWritten(engine == Engine::Reference ? SceneSubject::expected(view)
                                                            : SceneSubject::drawn(view, engine));
    }

private:
    image::Raster truth_;
    Bounds bounds_;
};

scene::Scene sceneOf(const std::string& name) {
    return cases::loadScene(cases::sharedDirectory() / "corpus" / (name + ".svg"));
}

Outcome againstTruth(const CorpusFile& file, const CorpusFile::Limit& limit, const SceneSettings& settings,
                     const Setting& setting) {
    if (const std::string why = absent(); !why.empty())
        return Outcome::skipped(why);
    const Bounds bounds{.mean = limit.mean(), .p999 = cases::truthP999};
    TruthSubject subject(sceneOf(file.name), settings, cases::truthOf(file.name, limit.size), bounds,
                         setting.fault);
    return judge(subject, setting);
}

Outcome againstReference(const scene::Scene& scene, const SceneSettings& settings, const Setting& setting) {
    SceneSubject subject(scene, settings, viewsOf(settings.views, scene, ""), setting.fault);
    return judge(subject, setting);
}

Outcome againstReference(const std::string& name, const SceneSettings& settings, const Setting& setting) {
    const std::string why = absent();
    return why.empty() ? againstReference(sceneOf(name), settings, setting) : Outcome::skipped(why);
}

/// The names of the SVG files in a folder, which may be absent.
std::vector<std::string> drawingsIn(const fs::path& folder) {
    std::vector<std::string> names;
    if (fs::exists(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".svg")
                names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

SceneSettings at(SceneSettings settings, int size) {
    settings.views.way = ViewPlan::Way::Whole;
    settings.views.raster = size;
    return settings;
}

/// Pixels a side.
constexpr int thumbnails[] = {8, 16, 32};

/// Where a pixel holds very much, the largest difference is what matters, and the evaluator's chords are no
/// yardstick.
SceneSettings crowded(SceneSettings settings) {
    settings.bounds = {.max = settings.bounds.max};
    settings.engines = {Engine::Gl, Engine::Scan};
    return settings;
}

/// Layer by layer, which the scanner does not do.
SceneSettings inLayers(SceneSettings settings) {
    settings.compile.mode = asset::Mode::Compat;
    settings.engines = {Engine::Gl, Engine::Asset};
    return settings;
}

}  // namespace

std::vector<Case> corpusCases(const Folder& folder) {
    const SceneSettings settings = sceneSettings(folder.settings);
    const std::string table = "conformance/cases/limits.tsv";
    std::vector<Case> cases;
    const auto add = [&](const std::string& name, const char* about, const auto& run) {
        cases.push_back({folder.name + "." + name, table, about, run});
    };
    for (const CorpusFile& file : vtm::cases::corpusFiles()) {
        for (const CorpusFile::Limit& limit : file.limits)
            add(fmt::format("truth.{}.{}px", file.name, limit.size),
                "A real file against ground truth made by another engine: at most a third of the best "
                "renderer's "
                "error, or three times what rounding costs.",
                [=](const Setting& setting) {
                    return againstTruth(file, limit, at(settings, limit.size), setting);
                });
        add("engines." + file.name + ".1024px", "A real file: every engine against the exact reference.",
            [=](const Setting& setting) { return againstReference(file.name, at(settings, 1024), setting); });
        add("engines." + file.name + ".64px",
            "A real file made small: the engines against the exact reference.", [=](const Setting& setting) {
                return againstReference(file.name, crowded(at(settings, 64)), setting);
            });
        for (const int size : thumbnails)
            add(fmt::format("thumbnails.{}.{}px", file.name, size),
                "A real file made very small: every engine against the exact reference.",
                [=](const Setting& setting) {
                    return againstReference(file.name, crowded(at(settings, size)), setting);
                });
    }
    for (const std::string& icon : drawingsIn(vtm::cases::sharedDirectory() / "corpus/icons"))
        add("icons." + icon, "A real icon at 64 pixels: every engine against the exact reference.",
            [=](const Setting& setting) {
                return againstReference("icons/" + icon, at(settings, 64), setting);
            });
    for (const std::string& icon : drawingsIn(vtm::cases::sharedDirectory() / "corpus/icons"))
        for (const int size : thumbnails)
            add(fmt::format("thumbnails.icons.{}.{}px", icon, size),
                "A real icon made very small: every engine against the exact reference.",
                [=](const Setting& setting) {
                    return againstReference("icons/" + icon, crowded(at(settings, size)), setting);
                });
    const fs::path own = vtm::cases::examplesDirectory();
    for (const std::string& name : drawingsIn(own))
        for (const bool layers : {false, true})
            add(fmt::format("own.{}.{}", name, layers ? "compat" : "exact"),
                "One of our own drawings at 256 pixels, in one of the two modes.",
                [=](const Setting& setting) {
                    const SceneSettings whole = at(settings, 256);
                    return againstReference(vtm::cases::loadScene(own / (name + ".svg")),
                                            layers ? inLayers(whole) : whole, setting);
                });
    return cases;
}

}  // namespace vtm::conformance

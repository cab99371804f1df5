// Rows of the paper: ROW-what.svg is drawn in paper mode, by its evaluator and its shader, and what the row
// promises beyond a picture is tried (paper_rows.cpp).

#include <fmt/core.h>

#include "conformance/reference/reference.hpp"
#include "conformance/runner/kinds/kinds.hpp"
#include "conformance/runner/kinds/paper_rows.hpp"
#include "conformance/runner/kinds/scene_subject.hpp"
#include "conformance/runner/kinds/svg_files.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/renderer.hpp"

namespace vtm::conformance {
namespace {

using image::Raster;

class PaperSubject : public Subject {
public:
    PaperSubject(const scene::Scene& scene, const SceneSettings& settings, const std::string& salt)
        : scene_(scene),
          settings_(settings),
          views_(viewsOf(settings.views, scene_, salt)),
          paper_(paper::compile(scene_).asset) {}

    std::size_t views() const override { return views_.size(); }
    std::string labelOf(std::size_t view) const override { return views_[view].label; }
    std::vector<Engine> engines(std::size_t) const override { return {Engine::Asset, Engine::Gl}; }
    Bounds bounds(Engine) const override { return settings_.bounds; }
    Raster expected(std::size_t view) override {
        const asset::View& v = views_[view].view;
        return reference::render(scene_, {v.width, v.height, v.toPixels});
    }
    Raster drawn(std::size_t view, Engine engine) override {
        if (engine == Engine::Asset)
            return paper::evaluate(paper_, views_[view].view);
        renderer();  // a current context
        return paper::Renderer().render(paper::Texture(paper_), views_[view].view);
    }

private:
    scene::Scene scene_;
    SceneSettings settings_;
    std::vector<LabelledView> views_;
    paper::Asset paper_;
};

Outcome run(const SvgCase& made, int row, const SceneSettings& settings, const Setting& setting) {
    const scene::Scene scene = made.scene();
    if (const RowCheck check = checkOfRow(row))
        if (const Outcome outcome = check(scene); outcome.status != Outcome::Status::Passed)
            return outcome;
    PaperSubject subject(scene, settings, made.name);
    return judge(subject, setting);
}

/// The number at the front of a file's name.
int rowOf(const SvgCase& made) {
    const std::string name = made.file.filename().string();
    if (!std::isdigit(static_cast<unsigned char>(name[0])))
        throw SuiteError(made.file.string() + ": the name does not begin with the row's number");
    return std::stoi(name);
}

}  // namespace

std::vector<Case> paperCases(const Folder& folder) {
    return svgCases(folder, [](const SvgCase& made) {
        SvgCase own = made;
        // Bounds differ from row to row: "rows" has settings by number.
        const int row = rowOf(made);
        const Settings rows = own.settings.value("rows", Settings::object());
        if (rows.contains(std::to_string(row)))
            own.settings.merge_patch(rows.at(std::to_string(row)));
        const SceneSettings settings = sceneSettings(own.settings);
        return [=](const Setting& setting) { return run(own, row, settings, setting); };
    });
}

}  // namespace vtm::conformance

#include "conformance/runner/kinds/scene_subject.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <vtm/raster/evaluate.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/cases/texture_views.hpp"
#include "conformance/reference/reference.hpp"
#include "paper/compile.hpp"
#include "paper/evaluate.hpp"

namespace vtm::conformance {
namespace {

using image::Raster;

/// The reference is judged in so many views: its pixels 4 × 4 as fine take 16 times as long.
constexpr std::size_t judgedReferences = 2;
constexpr int finer = 4;

Bounds boundsOf(const Settings& json) {
    Bounds bounds;
    const std::pair<const char*, double*> members[] = {{"max", &bounds.max},   {"mean", &bounds.mean},
                                                       {"rms", &bounds.rms},   {"p999", &bounds.p999},
                                                       {"flat", &bounds.flat}, {"twin", &bounds.twin}};
    for (const auto& [key, value] : json.items()) {
        const auto member = std::ranges::find_if(members, [&](const auto& m) { return key == m.first; });
        if (member == std::end(members))
            throw std::runtime_error("bounds: there is no '" + key + "'");
        *member->second = value.get<double>();
    }
    return bounds;
}

compiler::Options compileOptions(const Settings& json) {
    compiler::Options options;
    for (const auto& [key, value] : json.items()) {
        if (key == "tolerance-bits")
            options.tolerance = std::exp2(-value.get<double>());
        else if (key == "tolerance-pixels")
            continue;
        else if (key == "pieces-per-leaf")
            options.piecesPerLeaf = value.get<unsigned>();
        else if (key == "mode")
            options.mode = value == "compat" ? asset::Mode::Compat : asset::Mode::Exact;
        else
            throw std::runtime_error("compile: there is no '" + key + "'");
    }
    return options;
}

compiler::Options withFault(compiler::Options options, Fault fault) {
    if (fault == Fault::Layers)
        options.mode = asset::Mode::Compat;
    return options;
}

/// The largest factor by which a map stretches any direction, its larger singular value.
double stretch(const scene::Affine& m) {
    const double sum = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]), det = scene::determinant(m);
    return std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * det * det))) / 2);
}

/// Below 2^-24 nothing is proven (docs/regions.md).
constexpr double finestTolerance = 1.0 / (1 << 24);

compiler::Options compileFor(const SceneSettings& settings, const scene::Scene& scene,
                             const std::vector<LabelledView>& views) {
    compiler::Options options = settings.compile;
    if (!settings.tolerancePixels)
        return options;
    for (const LabelledView& view : views) {
        const double picture = stretch(view.view.toPixels) * std::max(scene.width, scene.height);
        options.tolerance = std::min(options.tolerance, *settings.tolerancePixels / picture);
    }
    options.tolerance = std::max(options.tolerance, finestTolerance);
    return options;
}

}  // namespace

SceneSettings sceneSettings(const Settings& settings) {
    SceneSettings result;
    for (const auto& name : settings.value("engines", Settings::array({"gl", "asset", "scan", "reference"})))
        result.engines.push_back(engineOf(name.get<std::string>()));
    result.bounds = boundsOf(settings.at("bounds"));
    result.views = viewPlan(nlohmann::json(settings.value("views", Settings::object())));
    const Settings compile = settings.value("compile", Settings::object());
    result.compile = compileOptions(compile);
    if (compile.contains("tolerance-pixels"))
        result.tolerancePixels = compile.at("tolerance-pixels").get<double>();
    return result;
}

gl::Renderer& renderer() {
    thread_local cases::Gl gl;
    return gl.renderer;
}

SceneSubject::SceneSubject(scene::Scene scene, SceneSettings settings, std::vector<LabelledView> views,
                           Fault fault)
    : scene_(std::move(scene)),
      settings_(std::move(settings)),
      views_(std::move(views)),
      fault_(fault),
      asset_(damaged(compiler::compile(scene_, withFault(compileFor(settings_, scene_, views_), fault)).asset,
                     fault)) {
    if (fault_ == Fault::HalfDistance || fault_ == Fault::Layers)
        settings_.engines = {Engine::Asset};
}

std::vector<Engine> SceneSubject::engines(std::size_t view) const {
    std::vector<Engine> engines = settings_.engines;
    if (view >= judgedReferences)
        std::erase(engines, Engine::Reference);
    // The scanner draws single maps, and finer pixels are other pixels for a filter.
    if (!asset_.filters.empty()) {
        std::erase(engines, Engine::Scan);
        std::erase(engines, Engine::Reference);
    }
    return engines;
}

Raster SceneSubject::reference(const asset::View& view) const {
    reference::Options options;
    if (settings_.compile.mode == asset::Mode::Compat)
        options.mode = reference::Mode::Compat;
    return reference::render(scene_, {view.width, view.height, view.toPixels}, options);
}

Raster SceneSubject::expected(std::size_t view) { return reference(views_[view].view); }

Raster SceneSubject::drawn(std::size_t index, Engine engine) {
    const asset::View& view = views_[index].view;
    if (fault_ == Fault::HalfDistance) {
        if (!paper_)
            paper_ = paper::compile(scene_).asset;
        return paper::evaluate(*paper_, view);
    }
    switch (engine) {
        case Engine::Gl:
            if (!texture_)
                texture_ = renderer().upload(asset_);
            return renderer().render(*texture_, view);
        case Engine::Asset:
            return asset::evaluate(asset_, view);
        case Engine::Scan:
            if (!scanner_)
                scanner_.emplace(asset_);
            return scanner_->draw(view);
        case Engine::Reference:
            return cases::averaged(
                reference({view.width * finer, view.height * finer, view.toPixels * double(finer)}), finer);
    }
    throw std::logic_error("an engine without a way to draw");
}

}  // namespace vtm::conformance

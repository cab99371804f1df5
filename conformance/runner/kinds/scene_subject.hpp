/// \file
/// A scene as a subject: compiled once, drawn by every engine, compared with the exact reference.
#pragma once

#include <optional>
#include <vector>

#include <vtm/compiler/compile.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/raster/scan.hpp>
#include "conformance/runner/judge/judge.hpp"
#include "conformance/runner/suite/suite.hpp"
#include "conformance/runner/suite/views.hpp"
#include "paper/model.hpp"

namespace vtm::conformance {

/// What a folder's settings say to this kind.
struct SceneSettings {
    std::vector<Engine> engines;
    Bounds bounds;
    ViewPlan views;
    compiler::Options compile;
    /// The tolerance is at most so many pixels of any view, where the format can.
    std::optional<double> tolerancePixels;
};
/// Throws std::runtime_error where a member is unknown or wrong.
SceneSettings sceneSettings(const Settings& settings);

class SceneSubject : public Subject {
public:
    SceneSubject(scene::Scene scene, SceneSettings settings, std::vector<LabelledView> views, Fault fault);

    std::size_t views() const override { return views_.size(); }
    std::string labelOf(std::size_t view) const override { return views_[view].label; }
    std::vector<Engine> engines(std::size_t view) const override;
    Bounds bounds(Engine) const override { return settings_.bounds; }
    image::Raster expected(std::size_t view) override;
    image::Raster drawn(std::size_t view, Engine engine) override;

private:
    image::Raster reference(const asset::View& view) const;

    scene::Scene scene_;
    SceneSettings settings_;
    std::vector<LabelledView> views_;
    Fault fault_;
    asset::Asset asset_;
    std::optional<asset::Scanner> scanner_;
    std::optional<gl::Texture> texture_;
    std::optional<paper::Asset> paper_;  ///< for Fault::HalfDistance
};

/// This thread's renderer, made when it is first asked for. Throws gl::GlError.
gl::Renderer& renderer();

}  // namespace vtm::conformance

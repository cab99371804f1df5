/// \file
/// Drawings that put very much into few pixels, made by formula.
#pragma once

#include <span>
#include <string>

namespace vtm::conformance {

struct CrowdedScene {
    const char* name;
    const char* about;
    /// Gradients that go through many shades within a pixel: engines are also compared with each other.
    bool varies;
    std::string (*svg)();
};

std::span<const CrowdedScene> crowdedScenes();

}  // namespace vtm::conformance

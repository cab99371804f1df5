/// \file
/// A file of the corpus, compiled, and its truth.
#pragma once

#include <vtm/compiler/compile.hpp>
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"

namespace vtm::cases {

/// A file of the corpus, compiled.
class Measurement {
public:
    /// Throws the modules' exceptions.
    explicit Measurement(const std::string& name);

    const scene::Scene& scene() const { return scene_; }
    const asset::Asset& asset() const { return asset_; }

private:
    scene::Scene scene_;
    asset::Asset asset_;
};

/// The ground truth of a file of the corpus.
image::Raster truthOf(const std::string& name, int size);

/// Bounds that hold for every file, in 1/255.
inline constexpr double truthP999 = 6, assetMax = 2, referenceMax = 4, referenceRms = 0.3;

}  // namespace vtm::cases

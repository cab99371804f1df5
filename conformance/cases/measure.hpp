/// \file
/// Figures of one file of the corpus, for the tests and for the table.
#pragma once

#include "compiler/compile.hpp"
#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"

namespace vtm::cases {

/// A file of the corpus on its way through every engine.
class Measurement {
public:
    /// Throws the modules' exceptions.
    explicit Measurement(const std::string& name);

    /// Against the ground truth, which must exist.
    compare::Difference glToTruth(Gl& gl, int size) const;
    compare::Difference glToAsset(Gl& gl, int size) const;
    compare::Difference glToReference(Gl& gl, int size) const;
    /// The scanner's picture against the shaders'.
    compare::Difference scanToGl(Gl& gl, int size) const;

    const scene::Scene& scene() const { return scene_; }
    const asset::Asset& asset() const { return asset_; }

private:
    std::string name_;
    scene::Scene scene_;
    asset::Asset asset_;
};

/// The ground truth of a file of the corpus.
image::Raster truthOf(const std::string& name, int size);

/// Bounds that hold for every file, in 1/255.
inline constexpr double truthP999 = 6, assetMax = 2, referenceMax = 4, referenceRms = 0.3;

}  // namespace vtm::cases

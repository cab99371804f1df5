/// \file
/// How a case is looked at: seeded affine views, whole pictures, floors in perspective.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <vtm/raster/view.hpp>
#include <vtm/scene/scene.hpp>

namespace vtm::conformance {

/// What "views" of a suite.json says.
struct ViewPlan {
    enum class Way {
        Affine,      ///< turned, sheared, sometimes mirrored, on or beside corners and ends of the outlines
        Whole,       ///< the picture fills the raster
        Sizes,       ///< at every size the whole picture, and a part of it as under Affine
        Perspective  ///< a floor of copies up to the horizon
    };
    Way way = Way::Affine;
    int count = 20;
    int raster = 96;                     ///< pixels a side; Whole: of the picture's width
    double fewest = 48, maximum = 1448;  ///< pixels that the picture's longer side takes, log-uniform
    double shear = 0.3;                  ///< radians by which the axes lean at most
    std::vector<int> sizes;  ///< Sizes: pixels of the picture's longer side, and a side of the part
    double ratio = 4;        ///< Perspective: of the longest footprint's sides
    std::uint64_t seed = 2005;
};
/// Throws std::runtime_error that names what is wrong.
ViewPlan viewPlan(const nlohmann::json& json);

struct LabelledView {
    asset::View view;
    std::string label;
    std::optional<glm::dmat3>
        toPicture;  ///< Perspective: (pixel, 1) to homogeneous (s, t); `view` has the size
};

/// The same for a scene's outlines, a plan and a salt on every machine.
std::vector<LabelledView> viewsOf(const ViewPlan& plan, const scene::Scene& scene, const std::string& salt);

/// A seed from a text (FNV-1a).
std::uint64_t seedOf(const std::string& text);

}  // namespace vtm::conformance

/// \file
/// The backend's programs, each compiled when it is first needed.
#pragma once

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "backend_gl/src/features.hpp"
#include "backend_gl/src/materials.hpp"
#include "backend_gl/src/program.hpp"

namespace vtm::gl {

/// Leaf programs by what a square of the tree costs.
enum class CostClass : unsigned {
    Solid,   ///< one colour
    Pieces,  ///< regions of solid colours
    General  ///< paint programs
};
inline constexpr unsigned costClassCount = 3;

/// Texture units, the same in every program.
enum class Unit : int { Texels, Images, Placements, Layer, Backdrop, Patches };

/// Each throws GlError with the driver's log where a program does not compile.
class Programs {
public:
    /// Materials that programs are compiled with, each list once. Number 0 is none.
    unsigned materialSet(std::span<const asset::Material> materials);

    /// Only General looks at the features and materials.
    const Program& leaf(CostClass cost, Features features, unsigned materialSet = 0);
    /// Of a picture: patches of one colour, and others.
    const Program& flat();
    const Program& patch(Features features, unsigned materialSet = 0);
    const Program& fill(Features features, unsigned materialSet = 0);
    const Program& layer();
    const Program& blend();

private:
    enum class Kind : unsigned { Solid, Pieces, General, Flat, Patch, Fill, Layer, Blend };
    const Program& get(Kind kind, Features features, unsigned materialSet = 0);
    Program make(Kind kind, Features features, unsigned materialSet) const;

    struct MaterialSet {
        std::vector<asset::Material> materials;
        std::string source;
    };
    std::vector<MaterialSet> materialSets_{{{}, materialsSource({})}};
    std::map<std::tuple<Kind, unsigned, unsigned>, Program> programs_;
};

}  // namespace vtm::gl

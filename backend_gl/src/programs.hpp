/// \file
/// The backend's programs, each compiled when it is first needed.
#pragma once

#include <map>
#include <utility>

#include "backend_gl/src/features.hpp"
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
enum class Unit : int { Texels, Images, Placements, Layer, Backdrop };

/// Each throws GlError with the driver's log where a program does not compile.
class Programs {
public:
    /// Only General looks at the features.
    const Program& leaf(CostClass cost, Features features);
    const Program& fill(Features features);
    const Program& layer();
    const Program& blend();

private:
    enum class Kind : unsigned { Solid, Pieces, General, Fill, Layer, Blend };
    const Program& get(Kind kind, Features features);
    static Program make(Kind kind, Features features);

    std::map<std::pair<Kind, unsigned>, Program> programs_;
};

}  // namespace vtm::gl

#include "backend_gl/debug.hpp"

#include <cmath>

#include "backend_gl/src/patch_atlas.hpp"

namespace vtm::gl {

PatchGrid patchGrid(const asset::Map& map, const asset::View& view) {
    return {std::ldexp(map.side, -patchLevelFor(map, view)), 1u << patchCellsLog2};
}

}  // namespace vtm::gl

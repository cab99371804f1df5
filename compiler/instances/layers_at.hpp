/// \file
/// Which layers lie over a point of the picture.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// A lowered scene with its small layers by cells of a grid, and the runs of the others by rows. It must
/// outlive this.
class LayersAt {
public:
    LayersAt(const LoweredScene& picture, const Square& square);

    /// Those that a point is inside of by their fill rules, ascending. On an outline it is on either side.
    std::vector<std::uint32_t> operator()(LatticePoint p) const;

private:
    struct LayerRun {
        std::uint32_t layer, run;
        Coord low, high, left;  ///< its least and largest y and its least x
    };
    struct SmallLayer {
        std::uint32_t layer;
        LatticePoint min, max;
    };
    std::size_t rowOf(Coord y) const;
    int cellOf(Coord v, Coord first) const;
    bool isInside(std::uint32_t layer, int winding) const;
    bool addSmall(std::uint32_t layer);

    const LoweredScene& picture_;
    const Square square_;
    std::vector<std::vector<LayerRun>> rows_;
    int cells_ = 1;  ///< a side
    std::vector<std::vector<SmallLayer>> grid_;
};

}  // namespace vtm::compiler

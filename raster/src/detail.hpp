/// \file
/// Levels of detail of boundaries: where pieces are shorter than a pixel, few straight ones that change no
/// pixel by 1/255 take their place. Which regions lie beside each other stays; each boundary keeps the area
/// on its sides.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "raster/detail_map.hpp"
#include "raster/planar_map.hpp"
#include "raster/src/boundaries.hpp"

namespace vtm::asset {

/// No piece that is put in place of others has more area on its other side than that by pixel of its length.
inline constexpr double movedArea = 1.0 / 512;

/// The square that boundaries are in: what else there is of a map may meet them on its border.
struct DetailSquare {
    glm::dvec2 min, max;

    bool isOnBorder(glm::dvec2 p) const {
        return p.x == min.x || p.x == max.x || p.y == min.y || p.y == max.y;
    }
};

/// A square on whose border no point lies.
inline constexpr DetailSquare noBorder{glm::dvec2(-1), glm::dvec2(-1)};

/// Pieces for pixels of that many lattice steps and larger ones. Chains of pieces between the same two
/// regions are followed as long as a straight piece stays near, and the points between two of these are moved
/// so that the areas beside the chain stay what they are. Points in which chains meet or end, and those on
/// the square's border, stay where they are, so that what is left is as closed as before. Islands that are
/// far below a pixel become triangles.
std::vector<PlanarPiece> mergeChains(std::span<const PlanarPiece> pieces, const DetailSquare& square,
                                     double pixel);

/// Boundaries by octave of the pixel, each made when it is first asked for. get() may be called from several
/// threads at once.
class DetailLevels {
public:
    DetailLevels() = default;
    ~DetailLevels() {
        for (const Level* level = first_.load(); level;)
            delete std::exchange(level, level->next);
    }
    DetailLevels(DetailLevels&& other) noexcept : first_(other.first_.exchange(nullptr)) {}
    DetailLevels& operator=(DetailLevels&& other) noexcept {
        other.first_ = first_.exchange(other.first_.load());
        return *this;
    }

    template <class Make>
    const Boundaries& get(int octave, Make&& make) const {
        const Level* first = first_.load(std::memory_order_acquire);
        for (const Level* level = first; level; level = level->next)
            if (level->octave == octave)
                return level->boundaries;
        auto made = std::make_unique<Level>(Level{octave, make(), first});
        // Two threads that make the same level make equal ones, and both stay.
        while (!first_.compare_exchange_weak(made->next, made.get(), std::memory_order_acq_rel)) {
        }
        return made.release()->boundaries;
    }

private:
    struct Level {
        int octave;
        Boundaries boundaries;
        const Level* next;
    };

    mutable std::atomic<const Level*> first_ = nullptr;
};

}  // namespace vtm::asset

/// \file
/// A run of layers and a set of them in; out comes what of the set may be seen, wherever the run stands.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/lower/lower.hpp"

namespace vtm::compiler {

/// Clips whose layers lie in a run themselves. They do not depend on what lies around it.
class OwnClips {
public:
    explicit OwnClips(const LoweredScene& picture);

    /// Whether the run has a layer of a clip.
    bool areIn(LayerRange run) const { return clips_[run.first + run.count] > clips_[run.first]; }

    /// Of a set of the run's layers (numbers in the run, ascending): without items that clips of the run
    /// alone cut away there, and without layers that clip the run's items alone.
    std::vector<std::uint32_t> visible(LayerRange run, std::span<const std::uint32_t> set) const;

private:
    /// Layers of items, from the first to the last.
    struct Users {
        std::uint32_t first = noIndex, last = 0;
        void add(const Users& other);
    };
    enum class Side { Outside, Inside, Unknown };
    struct Place {
        LayerRange run;
        std::span<const std::uint32_t> set;
    };

    static bool isIn(LayerRange run, std::uint32_t layer) {
        return layer >= run.first && layer < run.first + run.count;
    }
    static Side both(Side a, Side b);
    Side sideOf(std::uint32_t clip, const Place& at) const;
    bool isCutAway(const LoweredItem& item, const Place& at) const;

    const LoweredScene& picture_;
    std::vector<std::uint32_t> clips_;  ///< by layer: how many before it are of clips
    std::vector<Users> users_;          ///< by layer of a clip: what it clips
};

}  // namespace vtm::compiler

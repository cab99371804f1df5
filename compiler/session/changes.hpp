/// \file
/// What of a picture is what it was in the picture before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/lower/lowered_scene.hpp"

namespace vtm::compiler {

/// Two pictures whose outlines are in one store (OutlineCache). Layers are the same if outline, rule and use
/// (item or clip) are; those that have kept their order are matched.
struct LayerChanges {
    std::vector<std::uint32_t> after;   ///< of each layer before: its index now; `noIndex`: gone
    std::vector<std::uint32_t> before;  ///< of each layer now: its index before; `noIndex`: added

    /// Whether layers that stayed have other indices now.
    bool renumbers() const;
};

LayerChanges matchLayers(const LoweredScene& before, const LoweredScene& after);

/// Numbers of layers that last: a layer that stays keeps its name, and so does one whose outline alone
/// changed, if its neighbours stayed.
class LayerNames {
public:
    /// The names of a picture that comes after one with names.
    void update(const LoweredScene& after, const LayerChanges& changes);

    /// By layer.
    const std::vector<std::uint32_t>& names() const { return names_; }
    /// By name; `noIndex` if there is no such layer now.
    const std::vector<std::uint32_t>& layers() const { return layers_; }

private:
    std::uint32_t fresh();

    std::vector<std::uint32_t> names_, layers_, free_;
    std::vector<std::uint8_t> isItem_;  ///< by layer
};

/// Hashes of what an item is, besides its outline; zeros for a clip's layer. Between pictures with lasting
/// names, equal hashes mean that nothing changed.
struct LayerMeaning {
    /// What decides where it shows and what shows below: its clips, and whether it hides what is below.
    std::uint64_t shape = 0;
    /// What decides its part in a stack's paint: source, opacity, groups.
    std::uint64_t paint = 0;
};

/// By layer.
std::vector<LayerMeaning> meanings(const LoweredScene& picture, std::span<const std::uint32_t> names);

/// By group: whether an opaque item in it hides all that is below it, clips aside.
std::vector<std::uint8_t> groupsThatHide(const LoweredScene& picture);

/// Whether the item hides what is below where it is inside its clips; `groupHides`: of its group.
inline bool hides(const LoweredScene& picture, const LoweredItem& item, bool groupHides) {
    return groupHides && picture.sources[item.source].opaque && item.opacity >= 1;
}

}  // namespace vtm::compiler

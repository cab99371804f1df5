/// \file
/// Where one stands in the plane: inside which layers, and the paint that they make there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "compiler/containers/number_map.hpp"
#include "compiler/direct/layer_cover.hpp"
#include "compiler/direct/stack_tree.hpp"
#include "compiler/lower/lowered_scene.hpp"
#include "compiler/paint/palette.hpp"

namespace vtm::compiler {

/// A paint of regions: a number of colors(), or of programs() if it is one.
using RegionPaint = std::uint32_t;
inline constexpr RegionPaint programBit = 0x8000'0000u;

/// What is known of a region.
struct Region {
    RegionPaint paint = 0;
    /// Items' layers below this one do not matter: those from here on hide them.
    std::uint32_t hidden = 0;
    bool isOpaque = false;  ///< it does so alone
};

/// Walks through the regions of a lowered scene, from outside of all layers on. What a region is painted with
/// follows from the layers around it, and is asked for once for each set of them.
class RegionState {
public:
    explicit RegionState(const LoweredScene& picture);

    /// Crosses an edge of a layer: its winding number grows by `winding`.
    void cross(std::uint32_t layer, std::int32_t winding) {
        LayerState& s = layers_[layer];
        const bool before = s.isInside(s.winding);
        s.winding += winding;
        if (before != s.isInside(s.winding))
            toggle(layer, s.name);
    }

    /// Layers that were composited to find regions' colours, in all; those of a group, and deep stacks, count
    /// as several.
    std::size_t composited() const { return composited_; }
    /// Whether a stack of so many layers is deep.
    static bool isDeep(std::size_t layers) { return layers > shallow; }
    /// All stacks that come are taken to be deep.
    void preferDeep(bool prefers) { prefersTree_ = prefers && hasOnlyColors(); }

    /// Stands for the set of layers that are inside.
    std::uint64_t key() const { return key_; }
    /// What becomes of a key where a layer's winding number changes from `winding` by `change`.
    std::uint64_t keyAfter(std::uint64_t key, std::uint32_t layer, std::int32_t winding,
                           std::int32_t change) const {
        const LayerState& s = layers_[layer];
        return s.isInside(winding) != s.isInside(winding + change) ? key ^ s.name : key;
    }

    const Region& region() {
        std::uint32_t& number = known_[key_];
        if (number == NumberMap::unknown) {
            number = std::uint32_t(regions_.size());
            regions_.push_back(compute());
        }
        return regions_[number];
    }
    /// None is known from now on: the paints stay.
    void forgetRegions() {
        known_.clear();
        regions_.clear();
    }
    /// The same where very many are known.
    void forgetManyRegions() {
        if (regions_.size() >= manyRegions && !hasPrograms_)
            forgetRegions();
    }
    /// The same of a region of a few pixels, whose colour is set and not remembered. Not if there are
    /// programs.
    Region regionOfPixels(glm::vec4& color);
    /// Of another set; null if it was not asked for before. Valid until the next is asked for.
    const Region* known(std::uint64_t key) const {
        const std::uint32_t number = known_.at(key);
        return number == NumberMap::unknown ? nullptr : &regions_[number];
    }
    /// Whether a region hides the layer.
    bool isHidden(std::uint32_t layer, const Region& by) const {
        return layer < by.hidden && shades_[layer].kind != Shade::None;
    }
    /// Items' layers below this one do not matter, as far as a few of the topmost tell.
    std::uint32_t hiddenByFew() const;
    const LayerCover& cover(std::uint32_t layer) const { return covers_[layer]; }
    bool isOfClip(std::uint32_t layer) const { return shades_[layer].kind == Shade::None; }
    bool isInside(std::uint32_t layer, std::int32_t winding) const {
        return layers_[layer].isInside(winding);
    }
    /// Whether an item's layer is inside, and inside its clips.
    bool isShown(std::uint32_t layer) const { return isInside(layer) && !isClippedAway(layer); }
    bool isClipped(std::uint32_t layer) const { return shades_[layer].isClipped; }
    /// Whether a layer is only where its winding number is odd.
    bool isEvenOdd(std::uint32_t layer) const { return layers_[layer].mask == 1; }

    /// Premultiplied; the first is transparent. A colour may have several numbers.
    std::span<const glm::vec4> colors() const { return colors_; }
    bool isSame(RegionPaint a, RegionPaint b) const {
        return a == b || (((a | b) & programBit) == 0 && colors_[a] == colors_[b]);
    }
    std::span<const PaintProgram> programs() const { return programs_; }
    /// Whether paints may be programs.
    bool hasPrograms() const { return hasPrograms_; }
    /// Whether all paints are colours, and no layer is clipped or masked.
    bool hasOnlyColors() const { return !hasPrograms_ && !hasClips_; }
    /// Whether the programs that are remembered are as large as they should become.
    bool remembersMuch() const { return programSteps_ > mostProgramSteps; }
    /// A paint of its own.
    RegionPaint paintOf(const glm::vec4& color) { return colorNumber(color); }
    /// All paints, whose numbers are given anew.
    void forgetPaints();

private:
    static constexpr std::size_t mostProgramSteps = 1u << 18;
    /// So many layers are composited one by one.
    static constexpr std::size_t shallow = 96;
    /// A layer of a group takes as long as so many others, and so does a deep stack, in the mean.
    static constexpr std::size_t layersOfGrouped = 4, layersOfTree = 64;
    /// So many are looked up in a processor's cache.
    static constexpr std::size_t manyRegions = 1u << 14;
    /// Of more colours, none is looked for among those before.
    static constexpr std::size_t manyColors = 1u << 14;

    struct LayerState {
        std::int32_t winding = 0;
        std::int32_t mask = -1;  ///< of the winding number's bits that matter
        std::uint64_t name = 0;  ///< well mixed: stands for the layer in keys

        bool isInside(std::int32_t number) const { return (number & mask) != 0; }
    };
    /// What a layer paints by itself.
    struct Shade {
        enum : std::uint8_t {
            None,   ///< it is a clip's
            Solid,  ///< a colour in groups that are laid over what is there
            Other
        } kind = None;
        bool isClipped = false;
        bool isLaidOver = false;  ///< in no group but such
        bool isColor = false;
        std::uint32_t group = noIndex;  ///< the innermost that is translucent
        glm::vec4 color{0};             ///< with its opacity
    };
    /// A translucent group that is composited, from the top.
    struct Open {
        std::uint32_t group;
        glm::vec4 color{0};
        float light = 1;  ///< what is left of what lies below
    };

    void toggle(std::uint32_t layer, std::uint64_t name) {
        key_ ^= name;
        inside_[layer / 64] ^= std::uint64_t{1} << layer % 64;
        filled_[layer / 4096] = (filled_[layer / 4096] & ~(std::uint64_t{1} << layer / 64 % 64)) |
                                std::uint64_t{inside_[layer / 64] != 0} << layer / 64 % 64;
        if (tree_)
            tree_->change(layer);
    }
    template <class Visit>
    void forEachFromTop(Visit&& visit) const;
    bool isClippedAway(std::uint32_t layer) const;
    bool isInside(std::uint32_t layer) const { return (inside_[layer / 64] >> layer % 64 & 1) != 0; }
    Region compute();
    bool stackSolids(glm::vec4& color, Region& region);
    bool stackInGroups(glm::vec4& color, Region& region);
    void stackInTree(glm::vec4& color, Region& region);
    void closeDownTo(std::uint32_t group);
    void openUpTo(std::uint32_t group);
    RegionPaint colorNumber(const glm::vec4& color);
    RegionPaint computeAny(Region& region);
    bool listItems(Region& region);

    const LoweredScene& picture_;
    std::vector<LayerState> layers_;
    std::vector<Shade> shades_;               ///< by layer
    std::vector<LayerCover> covers_;          ///< by layer
    std::vector<std::uint32_t> translucent_;  ///< by group: the innermost round it and with it
    std::vector<Open> open_;
    std::uint64_t key_ = 0;
    std::vector<std::uint64_t> inside_;  ///< a bit a layer
    std::vector<std::uint64_t> filled_;  ///< a bit a word of inside_: it is not 0
    NumberMap known_;                    ///< by key: of regions_
    std::vector<Region> regions_;
    std::vector<glm::vec4> colors_;
    NumberMap colorNumbers_;  ///< by a hash of the colour
    Palette palette_;
    std::vector<PaintProgram> programs_;
    std::size_t programSteps_ = 0;        ///< in all of them
    std::vector<RegionPaint> ofPalette_;  ///< by paint of the palette
    std::vector<std::uint32_t> list_;     ///< items
    bool hasPrograms_ = false;
    std::size_t composited_ = 0;
    bool prefersTree_ = false;
    bool hasClips_ = false;          ///< or masks
    std::optional<StackTree> tree_;  ///< none until a stack is deep
};

}  // namespace vtm::compiler

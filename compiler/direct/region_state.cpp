#include "compiler/direct/region_state.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "compiler/direct/layer_cover.hpp"
#include "compiler/paint/composite.hpp"
#include "compiler/paint/region_paints.hpp"

namespace vtm::compiler {
namespace {

std::uint64_t hashOf(const glm::vec4& color) {
    std::uint64_t halves[2];
    static_assert(sizeof halves == sizeof color);
    std::memcpy(halves, &color[0], sizeof halves);
    return hashValue(hashValue(halves[0]) ^ halves[1]);
}

}  // namespace

RegionState::RegionState(const LoweredScene& picture)
    : picture_(picture),
      layers_(picture.layers.size()),
      shades_(picture.layers.size()),
      covers_(layerCovers(picture)),
      translucent_(picture.groups.size(), noIndex),
      inside_(picture.layers.size() / 64 + 1),
      filled_(inside_.size() / 64 + 1) {
    for (std::uint32_t l = 0; l < layers_.size(); ++l) {
        layers_[l].mask = picture.layers[l].rule == scene::FillRule::EvenOdd ? 1 : -1;
        layers_[l].name = hashValue(l);
    }
    const std::vector<std::uint8_t> isClipped = clippedGroups(picture);
    std::vector<std::uint8_t> isLaidOver(picture.groups.size());
    for (std::uint32_t g = 0; g < picture.groups.size(); ++g) {  // parents come first
        const LoweredGroup& group = picture.groups[g];
        const bool isRoot = group.parent == noIndex;
        isLaidOver[g] = (isRoot || isLaidOver[group.parent]) && group.role == GroupRole::Plain &&
                        group.blend == scene::BlendMode::Normal && group.mask == noIndex;
        translucent_[g] = group.opacity < 1 ? g : isRoot ? noIndex : translucent_[group.parent];
    }
    for (const LoweredItem& item : picture.items) {
        const Source& source = picture.sources[item.source];
        Shade& shade = shades_[item.layer];
        shade.isColor = source.op == asset::Op::Solid;
        shade.kind = isLaidOver[item.group] && shade.isColor ? Shade::Solid : Shade::Other;
        hasPrograms_ = hasPrograms_ || shade.kind == Shade::Other;
        hasClips_ = hasClips_ || isClipped[item.group] != 0;
        shade.isLaidOver = isLaidOver[item.group] != 0;
        shade.isClipped = isClipped[item.group] != 0;
        shade.group = translucent_[item.group];
        const auto& c = source.color;
        shade.color = item.opacity * glm::vec4(c[0], c[1], c[2], c[3]);
    }
    forgetPaints();
}

void RegionState::forgetPaints() {
    forgetRegions();
    colorNumbers_.clear();
    colors_.clear();
    programs_.clear();
    programSteps_ = 0;
    palette_ = Palette();
    ofPalette_.clear();
    colorNumber({0, 0, 0, 0});
}

/// Calls visit(layer), which tells whether to go on, for the layers that are inside.
template <class Visit>
void RegionState::forEachFromTop(Visit&& visit) const {
    for (std::size_t f = filled_.size(); f-- > 0;)
        for (std::uint64_t words = filled_[f]; words != 0;) {
            const auto w = std::size_t(std::bit_width(words) - 1);
            words ^= std::uint64_t{1} << w;
            for (std::uint64_t bits = inside_[64 * f + w]; bits != 0;) {
                const auto b = std::size_t(std::bit_width(bits) - 1);
                bits ^= std::uint64_t{1} << b;
                if (!visit(std::uint32_t(4096 * f + 64 * w + b)))
                    return;
            }
        }
}

std::uint32_t RegionState::hiddenByFew() const {
    constexpr int few = 16;
    LightBelow below;
    std::uint32_t hidden = 0;
    int looked = 0;
    forEachFromTop([&](std::uint32_t layer) {
        if (shades_[layer].kind != Shade::None && !isClippedAway(layer))
            below.add(covers_[layer]);
        if (below.light() <= unseen)
            hidden = layer;
        return hidden == 0 && ++looked < few;
    });
    return hidden;
}

/// By a clip of a group round it.
bool RegionState::isClippedAway(std::uint32_t layer) const {
    return shades_[layer].isClipped &&
           !insideClips(picture_, picture_.items[picture_.itemOfLayer[layer]].group,
                        [&](std::uint32_t clip) { return isInside(clip); });
}

Region RegionState::compute() {
    Region region;
    glm::vec4 color;
    region.paint = stackSolids(color, region) ? colorNumber(color) : computeAny(region);
    return region;
}

/// The usual case: all that shows is solid colours, laid over each other. False if it is not. Whether a stack
/// is deep depends on what lies above the layers that it hides, as its colour does.
bool RegionState::stackSolids(glm::vec4& color, Region& region) {
    if (prefersTree_) {
        stackInTree(color, region);
        return true;
    }
    bool isSolid = true, isInGroup = false, isDeep = false;
    glm::vec4 sum(0);
    float light = 1;
    std::size_t looked = 0;
    forEachFromTop([&](std::uint32_t layer) {
        const Shade& shade = shades_[layer];
        if (shade.kind == Shade::None || isClippedAway(layer))
            return true;
        isSolid = shade.kind == Shade::Solid;
        isInGroup = shade.group != noIndex;
        isDeep = ++looked > shallow && hasOnlyColors();
        if (!isSolid || isInGroup || isDeep)
            return false;
        sum += light * shade.color;
        light *= 1 - shade.color.w;
        if (light > unseen)
            return true;
        region.hidden = layer;
        region.isOpaque = shade.color.w >= 1;
        return false;
    });
    composited_ += looked;
    if (isDeep)
        stackInTree(color, region);
    else if (isInGroup && isSolid)
        return stackInGroups(color, region);
    else
        color = sum;
    return isSolid;
}

void RegionState::stackInTree(glm::vec4& color, Region& region) {
    if (!tree_) {
        std::vector<glm::vec4> colors;
        std::vector<std::uint32_t> groups;
        for (const Shade& shade : shades_) {
            colors.push_back(shade.color);
            groups.push_back(shade.group);
        }
        tree_.emplace(picture_, std::move(colors), groups, translucent_);
    }
    composited_ += layersOfTree;
    const StackColor stack = tree_->color(inside_);
    color = stack.color;
    region.hidden = stack.hidden;
    const Shade& last = shades_[stack.hidden];
    region.isOpaque = stack.hidden > 0 && last.group == noIndex && last.color.w >= 1;
}

/// The same in translucent groups.
bool RegionState::stackInGroups(glm::vec4& color, Region& region) {
    open_.assign(1, {noIndex});
    bool isSolid = true, isDeep = false;
    std::size_t looked = 0;
    forEachFromTop([&](std::uint32_t layer) {
        const Shade& shade = shades_[layer];
        if (shade.kind == Shade::None || isClippedAway(layer))
            return true;
        isSolid = shade.kind == Shade::Solid;
        looked += layersOfGrouped;
        isDeep = looked > shallow && hasOnlyColors();
        if (!isSolid || isDeep)
            return false;
        if (shade.group != open_.back().group) {
            closeDownTo(shade.group);
            openUpTo(shade.group);
        }
        Open& top = open_.back();
        if (top.light > unseen) {
            top.color += top.light * shade.color;
            top.light *= 1 - shade.color.w;
        }
        if (open_.front().light > unseen)
            return true;
        region.hidden = layer;
        region.isOpaque = open_.size() == 1 && shade.color.w >= 1;
        return false;
    });
    composited_ += looked;
    if (isDeep) {
        stackInTree(color, region);
        return true;
    }
    closeDownTo(noIndex);
    color = open_.front().color;
    return isSolid;
}

void RegionState::closeDownTo(std::uint32_t group) {
    const auto isAround = [&](std::uint32_t outer) {
        std::uint32_t g = group;
        while (g != noIndex && g != outer)
            g = picture_.groups[g].parent;
        return g == outer;
    };
    while (open_.size() > 1 && !isAround(open_.back().group)) {
        const Open child = open_.back();
        open_.pop_back();
        Open& parent = open_.back();
        const float opacity = picture_.groups[child.group].opacity;
        parent.color += parent.light * opacity * child.color;
        parent.light *= 1 - opacity * child.color.w;
    }
}

void RegionState::openUpTo(std::uint32_t group) {
    const std::size_t already = open_.size();
    while (group != open_[already - 1].group) {
        open_.push_back({group});
        const std::uint32_t parent = picture_.groups[group].parent;
        group = parent == noIndex ? noIndex : translucent_[parent];
    }
    std::reverse(open_.begin() + std::ptrdiff_t(already), open_.end());
}

RegionPaint RegionState::colorNumber(const glm::vec4& color) {
    if (colorNumbers_.count() >= manyColors) {
        colors_.push_back(color);
        return RegionPaint(colors_.size() - 1);
    }
    RegionPaint& number = colorNumbers_[hashOf(color + 0.0f)];  // -0 is 0
    if (number == NumberMap::unknown) {
        number = RegionPaint(colors_.size());
        colors_.push_back(color);
    }
    return number;
}

/// Lists the items that show, from the bottom. Of a deep stack, what no light comes through is left out.
/// Returns whether all are colours.
bool RegionState::listItems(Region& region) {
    constexpr std::size_t deep = 8;
    list_.clear();
    LightBelow below;
    bool areColors = true;
    forEachFromTop([&](std::uint32_t layer) {
        const Shade& shade = shades_[layer];
        if (shade.kind == Shade::None || isClippedAway(layer))
            return true;
        list_.push_back(picture_.itemOfLayer[layer]);
        areColors = areColors && shade.isColor;
        below.add(covers_[layer]);
        if (below.light() > unseen || list_.size() < deep)
            return true;
        region.hidden = layer;
        return false;
    });
    std::ranges::reverse(list_);
    return areColors;
}

RegionPaint RegionState::computeAny(Region& region) {
    if (listItems(region))
        return colorNumber(compositeColors(picture_, list_));
    const PaintId id = palette_.add(compositeItems(picture_, list_));
    if (ofPalette_.size() <= id)
        ofPalette_.resize(id + 1, NumberMap::unknown);
    RegionPaint& paint = ofPalette_[id];
    if (paint != NumberMap::unknown)
        return paint;
    const PaintProgram& program = palette_[id];
    if (Palette::isConstant(program)) {
        const Color c = Palette::colorOf(program);
        return paint = colorNumber({c[0], c[1], c[2], c[3]});
    }
    programs_.push_back(program);
    programSteps_ += program.size();
    return paint = RegionPaint(programs_.size() - 1) | programBit;
}

Region RegionState::regionOfPixels(glm::vec4& color) {
    Region region;
    stackSolids(color, region);
    return region;
}

}  // namespace vtm::compiler

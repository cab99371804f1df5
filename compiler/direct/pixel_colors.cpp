#include "compiler/direct/pixel_colors.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <glm/common.hpp>

#include "compiler/lower/walk_items.hpp"
#include "compiler/paint/composite.hpp"
#include "raster/blend.hpp"

namespace vtm::compiler {
namespace {

using Float4 = float __attribute__((vector_size(16)));

glm::vec4 vectorOf(Float4 color) { return std::bit_cast<glm::vec4>(color); }

Float4 over(Float4 source, Float4 backdrop) { return source + (1 - source[3]) * backdrop; }

/// A group, or a mask.
Float4 laidOver(const LoweredGroup& group, Float4 source, Float4 below) {
    if (group.role != GroupRole::Plain)
        return maskFactor(group.role, vectorOf(source)) * below;
    if (group.blend == scene::BlendMode::Normal)
        return over(group.opacity * source, below);
    return std::bit_cast<Float4>(
        asset::blend(blendOf(group.blend), group.opacity * vectorOf(source), vectorOf(below)));
}

}  // namespace

/// Composites layers from the bottom, with their groups round them.
template <std::size_t quarters>
class PixelColors::Groups {
public:
    /// `outer`: by group; those without one are no more than their layers.
    Groups(const LoweredScene& picture, std::span<const std::uint32_t> outer, const Quarters& below)
        : picture_(picture), outer_(outer), walk_(picture, *this), open_(1, below) {}

    void add(const LoweredItem& item, const Quarters& colors) {
        colors_ = &colors;
        walk_.item(item);
    }
    Quarters finish() {
        walk_.finish();
        return open_.front();
    }

    void open(std::uint32_t group) {
        if (outer_[group] != noIndex)
            open_.emplace_back();
    }
    void item(const LoweredItem&) {
        Quarters& below = open_.back();
        for (std::size_t i = 0; i < quarters; ++i)
            below[i] = over((*colors_)[i], below[i]);
    }
    void emptyMask(std::uint32_t) { open_.back() = {}; }
    void close(std::uint32_t group) {
        if (outer_[group] == noIndex)
            return;
        const Quarters source = open_.back();
        open_.pop_back();
        for (std::size_t i = 0; i < quarters; ++i)
            open_.back()[i] = laidOver(picture_.groups[group], source[i], open_.back()[i]);
    }

private:
    const LoweredScene& picture_;
    const std::span<const std::uint32_t> outer_;
    ItemWalk<Groups> walk_;
    std::vector<Quarters> open_;
    const Quarters* colors_ = nullptr;
};

void PixelColors::beginRow(int row) {
    if (!sources_)
        make();
    row_ = row;
    for (Pixel& pixel : pixels_) {
        pixel.layers.clear();
        pixel.parts.clear();
        pixel.colors.clear();
        pixel.below = {};
        pixel.isSteep = false;
        pixel.isBlended = false;
        pixel.known.keys.fill(0);
    }
}

void PixelColors::add(const RegionState& state, std::uint32_t layer, std::int32_t first, std::int32_t end,
                      bool inParts) {
    if (state.isOfClip(layer))
        return;
    const LayerCover& cover = state.cover(layer);
    const Source& source = picture_.sources[itemOf(layer).source];
    const bool isSteep = source.op != asset::Op::Solid && sources_->isSteep[source.data] != 0;
    inParts = inParts || state.isClipped(layer);
    end = std::min(end, std::int32_t(pixels_.size()));
    for (std::int32_t x = std::max(first, 0); x < end; ++x) {
        Pixel& pixel = pixels_[std::size_t(x)];
        if (cover.mayBeHidden && pixel.below.light() <= unseen)
            continue;
        pixel.layers.push_back({layer, inParts});
        pixel.isSteep = pixel.isSteep || isSteep;
        if (!inParts)
            pixel.below.add(cover);
    }
}

glm::vec4 PixelColors::color(const RegionState& state, const PixelPlace& place) {
    Pixel& pixel = pixels_[std::size_t(place.x)];
    const Quarters& quarters = regionOf(state, pixel, place.x);
    if (!pixel.isSteep)
        return vectorOf(quarters[0]);
    const glm::vec2 middle = glm::clamp(2.0f * place.middle - 0.5f, 0.0f, 1.0f);
    const Float4 upper = quarters[0] + middle.x * (quarters[1] - quarters[0]),
                 lower = quarters[2] + middle.x * (quarters[3] - quarters[2]);
    return vectorOf(upper + middle.y * (lower - upper));
}

const PixelColors::Quarters& PixelColors::regionOf(const RegionState& state, Pixel& pixel, int x) const {
    Known& known = pixel.known;
    const auto at = std::ranges::find(known.keys, state.key()) - known.keys.begin();
    if (std::size_t(at) < known.keys.size())
        return known.quarters[std::size_t(at)];
    if (pixel.parts.empty())
        divide(pixel);
    known.keys[known.next] = state.key();
    Quarters& quarters = known.quarters[known.next];
    known.next = (known.next + 1) % known.keys.size();
    quarters = pixel.isSteep ? composite<4>(state, pixel, x) : composite<1>(state, pixel, x);
    return quarters;
}

void PixelColors::divide(Pixel& pixel) const {
    const std::vector<Listed>& layers = pixel.layers;
    const auto count = std::uint32_t(layers.size());
    for (std::uint32_t i = 0, end; i < count; i = end) {
        const std::uint32_t outer = outerOf(layers[i].layer);
        bool isWhole = true;
        for (end = i; end == i || (end < count && outer != noIndex && outerOf(layers[end].layer) == outer);
             ++end)
            isWhole = isWhole && !layers[end].inParts;
        const auto isRun = [](const Part& each) { return each.isWhole && !each.isBlended; };
        const bool hasGroups = outer != noIndex;
        const Part part{i, end, hasGroups, isWhole, !isWhole && !hasGroups, isBlended(outer)};
        if (!pixel.parts.empty() && isRun(pixel.parts.back()) && isRun(part)) {
            pixel.parts.back().end = end;
            pixel.parts.back().hasGroups = pixel.parts.back().hasGroups || hasGroups;
        } else {
            pixel.parts.push_back(part);
        }
        pixel.isBlended = pixel.isBlended || part.isBlended;
    }
    // There is nothing below the lowest one.
    std::vector<Part>& parts = pixel.parts;
    while (parts.size() > 1 && parts.back().isWhole && parts[parts.size() - 2].isWhole) {
        const bool hasGroups = parts.back().hasGroups;
        parts.pop_back();
        parts.back().end = count;
        parts.back().hasGroups = parts.back().hasGroups || hasGroups;
    }
    if (!parts.empty() && parts.back().isWhole)
        parts.back().isBlended = false;
}

template <std::size_t quarters, class Next>
PixelColors::Quarters PixelColors::stacked(Next next) {
    Quarters sum{};
    std::array<float, quarters> light;
    light.fill(1);
    for (float most = 1; most > unseen;) {
        const Quarters* const colors = next();
        if (!colors)
            break;
        most = 0;
        for (std::size_t i = 0; i < quarters; ++i) {
            sum[i] += light[i] * (*colors)[i];
            light[i] *= 1 - (*colors)[i][3];
            most = std::max(most, light[i]);
        }
    }
    return sum;
}

template <std::size_t quarters>
PixelColors::Quarters PixelColors::composite(const RegionState& state, Pixel& pixel, int x) const {
    const auto isShown = [&](const Part& part) {
        return !part.isAlone || state.isShown(pixel.layers[part.first].layer);
    };
    if (!pixel.isBlended)
        return stacked<quarters>([&, at = std::size_t{0}]() mutable -> const Quarters* {
            while (at < pixel.parts.size() && !isShown(pixel.parts[at]))
                ++at;
            return at < pixel.parts.size() ? &colorsOf<quarters>(state, pixel, pixel.parts[at++], x)
                                           : nullptr;
        });
    Quarters sum{};
    for (std::size_t p = pixel.parts.size(); p-- > 0;) {
        Part& part = pixel.parts[p];
        if (part.isBlended) {
            sum = inGroups<quarters>(state, pixel, part, x, sum);
        } else if (isShown(part)) {
            const Quarters& colors = colorsOf<quarters>(state, pixel, part, x);
            for (std::size_t i = 0; i < quarters; ++i)
                sum[i] = over(colors[i], sum[i]);
        }
    }
    return sum;
}

/// Of a part that is laid over what lies below it.
template <std::size_t quarters>
const PixelColors::Quarters& PixelColors::colorsOf(const RegionState& state, Pixel& pixel, Part& part,
                                                   int x) const {
    if (part.isKnown)
        return part.colors;
    part.isKnown = part.isWhole || part.isAlone;
    if (part.hasGroups)
        part.colors = inGroups<quarters>(state, pixel, part, x, {});
    else
        part.colors =
            stacked<quarters>([&, at = part.first, colors = Quarters{}]() mutable -> const Quarters* {
                if (at == part.end)
                    return nullptr;
                colors = colorsOf(pixel.layers[at++].layer, x, quarters > 1);
                return &colors;
            });
    return part.colors;
}

/// Of layers in groups, laid over or blended with what is below.
template <std::size_t quarters>
PixelColors::Quarters PixelColors::inGroups(const RegionState& state, Pixel& pixel, const Part& part, int x,
                                            const Quarters& below) const {
    Groups<quarters> groups(picture_, sources_->outer, below);
    for (std::uint32_t i = part.end; i-- > part.first;) {
        Listed& listed = pixel.layers[i];
        if (listed.inParts && !state.isShown(listed.layer))
            continue;
        if (listed.known == noIndex) {
            listed.known = std::uint32_t(pixel.colors.size());
            pixel.colors.push_back(colorsOf(listed.layer, x, quarters > 1));
        }
        groups.add(itemOf(listed.layer), pixel.colors[listed.known]);
    }
    return groups.finish();
}

PixelColors::Quarters PixelColors::colorsOf(std::uint32_t layer, int x, bool inQuarters) const {
    const LoweredItem& item = itemOf(layer);
    const Source& source = picture_.sources[item.source];
    Quarters colors;
    if (source.op == asset::Op::Solid) {
        colors.fill(std::bit_cast<Float4>(source.color));
    } else {
        const asset::PixelPaints& pixels = *sources_->pixels;
        const std::uint32_t paint = sources_->paints[source.data];
        if (inQuarters && sources_->isSteep[source.data] != 0)
            colors = std::bit_cast<Quarters>(pixels.quarters(paint, x, row_));
        else
            colors.fill(std::bit_cast<Float4>(pixels.color(paint, x, row_)));
    }
    for (Float4& color : colors)
        color *= item.opacity;
    return colors;
}

void PixelColors::make() {
    sources_ = std::make_unique<Sources>();
    asset::Asset& asset = sources_->asset;
    asset.data = picture_.data;
    sources_->paints.resize(picture_.data.size(), noIndex);
    for (const Source& source : picture_.sources)
        if (source.op != asset::Op::Solid && sources_->paints[source.data] == noIndex) {
            sources_->paints[source.data] = std::uint32_t(asset.paints.size());
            asset.paints.push_back(
                encodePaint({{{source.op, asset::Blend::Normal, 1, source.data}, {}}}, asset.data));
        }
    asset::AssetView view(asset);
    view.images = bitmaps_;
    sources_->pixels.emplace(view, images_, view_);
    sources_->isSteep.resize(picture_.data.size());
    for (const Source& source : picture_.sources)
        if (source.op != asset::Op::Solid)
            sources_->isSteep[source.data] = sources_->pixels->isSteep(sources_->paints[source.data]);
    findOuter();
    pixels_.resize(std::size_t(view_.width));
}

void PixelColors::findOuter() {
    const std::vector<LoweredGroup>& groups = picture_.groups;
    std::vector<std::uint32_t>& outer = sources_->outer;
    outer.assign(groups.size(), noIndex);
    // What is blended sees only what is in the group round it; nothing is below the root.
    for (std::uint32_t g = 0; g < groups.size(); ++g)
        if (const std::uint32_t parent = groups[g].parent;
            groups[g].blend != scene::BlendMode::Normal && parent != noIndex && groups[parent].depth > 1)
            outer[parent] = parent;
    for (std::uint32_t g = 0; g < groups.size(); ++g) {  // parents come first
        const LoweredGroup& group = groups[g];
        if (group.parent != noIndex && outer[group.parent] != noIndex)
            outer[g] = outer[group.parent];
        else if (group.role != GroupRole::Plain || group.opacity < 1 ||
                 group.blend != scene::BlendMode::Normal || group.mask != noIndex)
            outer[g] = g;
    }
}

}  // namespace vtm::compiler

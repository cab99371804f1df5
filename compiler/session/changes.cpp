#include "compiler/session/changes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>

#include "compiler/containers/hash.hpp"

namespace vtm::compiler {
namespace {

bool isItem(const LoweredScene& picture, std::uint32_t layer) {
    return picture.itemOfLayer[layer] != noIndex;
}

bool sameLayer(const LoweredScene& p, std::uint32_t a, const LoweredScene& q, std::uint32_t b) {
    const Layer &x = p.layers[a], &y = q.layers[b];
    return x.firstRun == y.firstRun && x.runCount == y.runCount && x.rule == y.rule &&
           isItem(p, a) == isItem(q, b);
}

std::uint64_t hashOf(const LoweredScene& p, std::uint32_t layer) {
    const Layer& l = p.layers[layer];
    return hashCombine(hashCombine(l.firstRun, l.runCount),
                       (l.rule == scene::FillRule::NonZero ? 0 : 1) + (isItem(p, layer) ? 2 : 0));
}

/// Matches the layers between `first` and the ends, greedily: each with the next equal one.
void matchMiddle(const LoweredScene& before, std::uint32_t endBefore, const LoweredScene& after,
                 std::uint32_t endAfter, std::uint32_t first, LayerChanges& changes) {
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> places;  // descending
    for (std::uint32_t j = endAfter; j-- > first;)
        places[hashOf(after, j)].push_back(j);
    std::uint32_t next = first;
    for (std::uint32_t i = first; i < endBefore; ++i) {
        const auto found = places.find(hashOf(before, i));
        if (found == places.end())
            continue;
        std::vector<std::uint32_t>& equal = found->second;
        while (!equal.empty() && equal.back() < next)
            equal.pop_back();
        if (equal.empty() || !sameLayer(before, i, after, equal.back()))
            continue;
        changes.after[i] = equal.back();
        next = equal.back() + 1;
    }
}

}  // namespace

bool LayerChanges::renumbers() const {
    for (std::uint32_t i = 0; i < after.size(); ++i)
        if (after[i] != noIndex && after[i] != i)
            return true;
    return false;
}

LayerChanges matchLayers(const LoweredScene& before, const LoweredScene& after) {
    auto endBefore = static_cast<std::uint32_t>(before.layers.size()),
         endAfter = static_cast<std::uint32_t>(after.layers.size());
    LayerChanges changes{std::vector<std::uint32_t>(endBefore, noIndex),
                         std::vector<std::uint32_t>(endAfter, noIndex)};
    std::uint32_t first = 0;
    for (; first < std::min(endBefore, endAfter) && sameLayer(before, first, after, first); ++first)
        changes.after[first] = first;
    for (; std::min(endBefore, endAfter) > first && sameLayer(before, endBefore - 1, after, endAfter - 1);) {
        --endBefore, --endAfter;
        changes.after[endBefore] = endAfter;
    }
    matchMiddle(before, endBefore, after, endAfter, first, changes);
    for (std::uint32_t i = 0; i < changes.after.size(); ++i)
        if (changes.after[i] != noIndex)
            changes.before[changes.after[i]] = i;
    return changes;
}

// ---- names ------------------------------------------------------------------------------------

std::uint32_t LayerNames::fresh() {
    if (free_.empty()) {
        layers_.push_back(noIndex);
        return static_cast<std::uint32_t>(layers_.size() - 1);
    }
    const std::uint32_t name = free_.back();
    free_.pop_back();
    return name;
}

void LayerNames::update(const LoweredScene& after, const LayerChanges& changes) {
    std::vector<std::uint32_t> names(changes.before.size(), noIndex);
    std::vector<std::uint8_t> items(names.size());
    std::vector<std::uint32_t> left;  // names whose layers are gone, and nobody has taken them
    std::uint32_t i = 0;              // all layers before it are dealt with
    for (std::uint32_t j = 0; j < names.size(); ++j) {
        items[j] = isItem(after, j);
        if (changes.before[j] != noIndex) {
            for (; i < changes.before[j]; ++i)
                left.push_back(names_[i]);
            names[j] = names_[i++];
        } else if (i < changes.after.size() && changes.after[i] == noIndex && isItem_[i] == items[j]) {
            names[j] = names_[i++];
        }
    }
    for (; i < changes.after.size(); ++i)
        left.push_back(names_[i]);
    // What a new layer is called must not be in any stack that is kept: names are free only now.
    for (std::uint32_t name : left)
        layers_[name] = noIndex;
    for (std::uint32_t j = 0; j < names.size(); ++j) {
        if (names[j] == noIndex)
            names[j] = fresh();
        layers_[names[j]] = j;
    }
    free_.insert(free_.end(), left.begin(), left.end());
    names_ = std::move(names);
    isItem_ = std::move(items);
}

// ---- meanings ---------------------------------------------------------------------------------

namespace {

/// By source: where its record is, and what it says. Records lie in the order of their sources.
std::vector<std::uint64_t> hashesOfSources(const LoweredScene& picture) {
    std::vector<std::uint64_t> hashes(picture.sources.size());
    std::size_t end = picture.data.size();
    for (std::size_t i = picture.sources.size(); i-- > 0;) {
        const Source& source = picture.sources[i];
        std::uint64_t h = std::uint64_t{static_cast<std::uint32_t>(source.op)} << 1 | source.opaque;
        for (const float c : source.color)
            h = hashCombine(h, bits(c));
        if (source.op != asset::Op::Solid) {
            h = hashCombine(h, source.data);
            for (std::size_t texel = source.data; texel < end; ++texel)
                for (const std::uint32_t number : picture.data[texel])
                    h = hashCombine(h, number);
            end = source.data;
        }
        hashes[i] = h;
    }
    return hashes;
}

/// Of all images and materials: what a record's number of one stands for.
std::uint64_t hashOfImages(const LoweredScene& picture) {
    std::uint64_t h = 0;
    for (const auto& image : picture.images)
        h = hashCombine(h, reinterpret_cast<std::uintptr_t>(image.get()));
    for (const asset::Material& material : picture.materials)
        h = hashCombine(hashCombine(h, std::hash<std::string>{}(material.name)),
                        std::hash<std::string>{}(material.glsl));
    return h;
}

class Meanings {
public:
    Meanings(const LoweredScene& picture, std::span<const std::uint32_t> names)
        : picture_(picture),
          names_(names),
          hides_(groupsThatHide(picture)),
          clips_(picture.groups.size()),
          paints_(picture.groups.size()),
          sources_(hashesOfSources(picture)),
          images_(hashOfImages(picture)),
          firstItem_(picture.groups.size(), noIndex) {
        for (const LoweredItem& item : picture.items)
            for (std::uint32_t g = item.group; g != noIndex && firstItem_[g] == noIndex;
                 g = picture.groups[g].parent)
                firstItem_[g] = names[item.layer];
        for (std::uint32_t g = 0; g < picture.groups.size(); ++g)  // parents come first
            group(g);
    }

    LayerMeaning of(const LoweredItem& item) const {
        const Source& source = picture_.sources[item.source];
        std::uint64_t paint = hashCombine(paints_[item.group], bits(item.opacity));
        paint = hashCombine(paint, sources_[item.source]);
        if (source.op == asset::Op::Image || source.op == asset::Op::Material)
            paint = hashCombine(paint, images_);
        return {hashCombine(clips_[item.group], hides(picture_, item, hides_[item.group])), paint};
    }

private:
    /// A group is called after its first item.
    void group(std::uint32_t index) {
        const LoweredGroup& g = picture_.groups[index];
        const bool root = g.parent == noIndex;
        clips_[index] = root ? 0 : clips_[g.parent];
        if (g.clip != noIndex)
            clips_[index] = hashCombine(clips_[index], clip(g.clip));
        std::uint64_t h = hashCombine(root ? 0 : paints_[g.parent], firstItem_[index]);
        h = hashCombine(
            h, std::uint64_t{static_cast<std::uint32_t>(g.role)} << 32 | static_cast<std::uint32_t>(g.blend));
        h = hashCombine(h, bits(g.opacity));
        paints_[index] = hashCombine(h, g.mask != noIndex);
    }

    std::uint64_t clip(std::uint32_t index) const {
        if (index == noIndex)
            return 0;
        const ClipExpression& e = picture_.clips[index];
        std::uint64_t h = hashCombine(clip(e.outer), e.terms.size());
        for (const ClipExpression::Term& term : e.terms)
            h = hashCombine(hashCombine(hashCombine(h, names_[term.layer]), term.inverted), clip(term.clip));
        return hashCombine(h, 1);
    }

    const LoweredScene& picture_;
    const std::span<const std::uint32_t> names_;
    const std::vector<std::uint8_t> hides_;
    std::vector<std::uint64_t> clips_, paints_;  ///< by group
    const std::vector<std::uint64_t> sources_;
    const std::uint64_t images_;
    std::vector<std::uint32_t> firstItem_;  ///< by group: its layer's name
};

}  // namespace

std::vector<LayerMeaning> meanings(const LoweredScene& picture, std::span<const std::uint32_t> names) {
    std::vector<LayerMeaning> all(picture.layers.size());
    const Meanings of(picture, names);
    for (const LoweredItem& item : picture.items)
        all[item.layer] = of.of(item);
    return all;
}

std::vector<std::uint8_t> groupsThatHide(const LoweredScene& picture) {
    std::vector<std::uint8_t> hide(picture.groups.size());
    for (std::uint32_t g = 0; g < hide.size(); ++g) {
        const LoweredGroup& group = picture.groups[g];
        hide[g] = group.role == GroupRole::Plain && group.opacity >= 1 &&
                  group.blend == scene::BlendMode::Normal && group.mask == noIndex &&
                  (group.parent == noIndex || hide[group.parent]);
    }
    return hide;
}

}  // namespace vtm::compiler

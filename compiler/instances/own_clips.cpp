#include "compiler/instances/own_clips.hpp"

#include <algorithm>

namespace vtm::compiler {

void OwnClips::Users::add(const Users& other) {
    first = std::min(first, other.first);
    last = std::max(last, other.last);
}

OwnClips::OwnClips(const LoweredScene& picture) : picture_(picture), users_(picture.layers.size()) {
    clips_.reserve(picture.layers.size() + 1);
    clips_.push_back(0);
    for (const std::uint32_t item : picture.itemOfLayer)
        clips_.push_back(clips_.back() + (item == noIndex ? 1 : 0));
    // Parents stand before children, and clips behind those that they name.
    std::vector<Users> ofGroups(picture.groups.size()), ofClips(picture.clips.size());
    for (const LoweredItem& item : picture.items)
        ofGroups[item.group].add({item.layer, item.layer});
    for (std::size_t g = picture.groups.size(); g-- > 0;) {
        const LoweredGroup& group = picture.groups[g];
        if (group.parent != noIndex)
            ofGroups[group.parent].add(ofGroups[g]);
        if (group.clip != noIndex)
            ofClips[group.clip].add(ofGroups[g]);
    }
    for (std::size_t c = picture.clips.size(); c-- > 0;) {
        const ClipExpression& clip = picture.clips[c];
        for (const ClipExpression::Term& term : clip.terms) {
            users_[term.layer].add(ofClips[c]);
            if (term.clip != noIndex)
                ofClips[term.clip].add(ofClips[c]);
        }
        if (clip.outer != noIndex)
            ofClips[clip.outer].add(ofClips[c]);
    }
}

OwnClips::Side OwnClips::both(Side a, Side b) {
    if (a == Side::Outside || b == Side::Outside)
        return Side::Outside;
    return a == Side::Inside ? b : a;
}

OwnClips::Side OwnClips::sideOf(std::uint32_t clip, const Place& at) const {
    if (clip == noIndex)
        return Side::Inside;
    const ClipExpression& expression = picture_.clips[clip];
    Side any = Side::Outside;
    for (const ClipExpression::Term& term : expression.terms) {
        Side own = Side::Unknown;
        if (isIn(at.run, term.layer)) {
            const bool isInside = std::ranges::binary_search(at.set, term.layer - at.run.first);
            own = isInside != term.inverted ? Side::Inside : Side::Outside;
        }
        own = both(own, sideOf(term.clip, at));
        if (own == Side::Inside || (own == Side::Unknown && any == Side::Outside))
            any = own;
    }
    return both(any, sideOf(expression.outer, at));
}

bool OwnClips::isCutAway(const LoweredItem& item, const Place& at) const {
    for (std::uint32_t group = item.group; group != noIndex; group = picture_.groups[group].parent)
        if (sideOf(picture_.groups[group].clip, at) == Side::Outside)
            return true;
    return false;
}

std::vector<std::uint32_t> OwnClips::visible(LayerRange run, std::span<const std::uint32_t> set) const {
    std::vector<std::uint32_t> visible;
    for (const std::uint32_t number : set) {
        const std::uint32_t layer = run.first + number, item = picture_.itemOfLayer[layer];
        const Users& users = users_[layer];
        const bool isHidden = item != noIndex ? isCutAway(picture_.items[item], {run, set})
                                              : isIn(run, users.first) && isIn(run, users.last);
        if (!isHidden)
            visible.push_back(number);
    }
    return visible;
}

}  // namespace vtm::compiler

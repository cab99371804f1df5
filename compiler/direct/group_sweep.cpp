// The members of a group, swept on their own: from vertex to vertex and from crossing to crossing.

#include "compiler/direct/band_sweep.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/inversions.hpp"
#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

/// Crossings between two vertices, times the number of chains, that are found one by one.
constexpr std::size_t maxCrossings = 16;
constexpr std::size_t fewMembers = 64;

}  // namespace

bool BandSweep::isLeft(const Active* a, const Active* b) {
    return a->x != b->x ? a->x < b->x : a->slope < b->slope;
}

/// Of members that stand right of all that are done.
void BandSweep::enterSweep() {
    leftRegion_ = done_.empty() ? Region{} : done_.back()->region;
    leftKey_ = done_.empty() ? 0 : done_.back()->key;
    ++sweepNumber_;
}

const Region& BandSweep::regionLeftOf(std::size_t member) const {
    return member == 0 ? leftRegion_ : members_[member - 1]->region;
}
std::uint64_t BandSweep::keyLeftOf(std::size_t member) const {
    return member == 0 ? leftKey_ : members_[member - 1]->key;
}

/// The winding numbers that layers may have between some chains.
void BandSweep::openWindow(std::span<Active* const> chains) {
    ++windowNumber_;
    for (const Active* each : chains) {
        const Active& a = *each;
        Winding& w = windings_[a.layer];
        if (w.window != windowNumber_) {
            w.window = windowNumber_;
            w.now = w.least = w.most = a.before;
        }
        (a.winding < 0 ? w.least : w.most) += a.winding;
    }
}

/// Whether chains of an open window may be put into another order without asking where they cross. The
/// winding number of a layer that does not vanish whatever the order is that of its inside everywhere; its
/// chains show nothing, and change nothing that others show. So it is with what is hidden. All others must
/// not cross each other. `left`: the region on the left.
template <class IsOrdered>
bool BandSweep::isQuiet(std::span<Active* const> chains, const Region& left,
                        const IsOrdered& areOrdered) const {
    const Region hiding = staysHidden(chains, left) ? left : Region{};
    const Active* last = nullptr;
    for (const Active* each : chains) {
        const Active& a = *each;
        const Winding& w = windings_[a.layer];
        if (state_.isHidden(a.layer, hiding) || (!state_.isEvenOdd(a.layer) && (w.least > 0 || w.most < 0)))
            continue;
        if (last && !areOrdered(*last, a))
            return false;
        last = &a;
    }
    return true;
}

/// Whether what the region on the left hides is hidden between all of the chains.
bool BandSweep::staysHidden(std::span<Active* const> chains, const Region& left) const {
    return std::ranges::none_of(chains, [&](const Active* a) {
        if (left.isOpaque && a->layer != left.hidden && !state_.isOfClip(a->layer))
            return false;
        return state_.isOfClip(a->layer) ||
               (a->layer >= left.hidden && state_.isInside(a->layer, windings_[a->layer].now));
    });
}

bool BandSweep::mayReorder(Slab slab) {
    openWindow(members_);
    return isQuiet(members_, leftRegion_,
                   [&](const Active& a, const Active& b) { return isOrdered(a, b, slab.bottom); });
}

void BandSweep::reorder(Slab slab) {
    for (Active* a : members_)
        passBends(*a, slab.bottom);
    sortStably(members_.begin(), members_.end(), isLeftNext);
    relabel(0, members_.size(), slab.bottom);
    keepState(0);
    steps_ += members_.size();
}

void BandSweep::sweep(Slab slab) {
    sortStably(starting_.begin(), starting_.end(),
               [&](std::uint32_t a, std::uint32_t b) { return chains_[a].top > chains_[b].top; });
    line_ = slab.top;
    for (const Active* a : members_)
        if (Winding& w = windings_[a->layer]; w.sweep != sweepNumber_) {
            w.sweep = sweepNumber_;
            w.left = a->before;
        }
    for (;;) {
        limits::check();
        meetVertices(line_);
        if (line_ >= slab.bottom)
            break;
        float next = slab.bottom;
        if (!starting_.empty())
            next = std::min(next, chains_[starting_.back()].top);
        for (const Active* a : members_)
            next = std::min(next, a->b.y);
        moveTo(next);
        steps_ += members_.size() + 4;
    }
    keepState(0);
}

/// At the line: chains end, begin, and go on with their next edges.
void BandSweep::meetVertices(float y) {
    bool changes = false;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        Active& a = *members_[i];
        if (a.b.y <= y) {
            draw(a, a.from, y);
            a.from = y;
            if (!nextEdge(a)) {
                changes = true;
                keepState(kept);
                release(a);
                continue;
            }
            a.x = a.next = a.a.x;
        }
        members_[kept++] = &a;
    }
    members_.resize(kept);
    if (!starting_.empty() && chains_[starting_.back()].top <= y) {
        addStarting(y);
        changes = true;
    }
    if (changes)
        label(y);
}

/// Those that begin at the line, in their places.
void BandSweep::addStarting(float y) {
    added_.clear();
    for (; !starting_.empty() && chains_[starting_.back()].top <= y; starting_.pop_back()) {
        knowWindingLeftOf(chains_[starting_.back()].layer);
        added_.push_back(activate(starting_.back()));
        added_.back()->x = added_.back()->next = added_.back()->a.x;
        added_.back()->from = y;
    }
    sortStably(added_.begin(), added_.end(), isLeft);
    merged_.resize(members_.size() + added_.size());
    std::merge(members_.begin(), members_.end(), added_.begin(), added_.end(), merged_.begin(), isLeft);
    keepState(0);
    members_.swap(merged_);
}

/// Of the layer of a chain that is about to begin; most have no other chain that the line cuts.
void BandSweep::knowWindingLeftOf(std::uint32_t layer) {
    Winding& w = windings_[layer];
    if (w.sweep == sweepNumber_)
        return;
    w.sweep = sweepNumber_;
    w.left = 0;
    if (w.chains == 0)
        return;
    for (std::size_t i = done_.size(); i-- > 0;)
        if (done_[i]->layer == layer) {
            w.left = done_[i]->before + done_[i]->winding;
            return;
        }
}

/// All sets and paints anew, from the left.
void BandSweep::label(float y) {
    stripSteps_ += 4 * members_.size();
    ++windowNumber_;
    for (const Active* a : members_) {
        Winding& w = windings_[a->layer];
        if (w.window == windowNumber_)
            continue;
        w.window = windowNumber_;
        w.now = w.sweep == sweepNumber_ ? w.left : 0;
    }
    relabel(0, members_.size(), y);
}

/// Those of some members, whose layers' winding numbers are set.
void BandSweep::relabel(std::size_t first, std::size_t end, float y) {
    Region left = regionLeftOf(first);
    std::uint64_t key = keyLeftOf(first);
    for (std::size_t i = first; i < end; ++i) {
        Active& a = *members_[i];
        Winding& w = windings_[a.layer];
        a.before = w.now;
        w.now += a.winding;
        a.key = state_.keyAfter(key, a.layer, a.before, a.winding);
        a.region = regionAfter(i, left, key);
        setSides(a, left.paint, a.region.paint, y);
        left = a.region;
        key = a.key;
    }
}

/// Down to the next vertex.
void BandSweep::moveTo(float y) {
    // A level edge takes a chain past others.
    for (std::size_t i = 1; i < members_.size(); ++i)
        for (std::size_t k = i; k > 0 && members_[k - 1]->x > members_[k]->x; --k)
            swap(k - 1, line_);
    bool isSorted = true;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        members_[i]->next = members_[i]->xAt(y);
        isSorted = isSorted && (i == 0 || members_[i - 1]->next <= members_[i]->next);
    }
    if (!isSorted) {
        // Of members that are in another order at y, windows, each of which keeps its place.
        least_.resize(members_.size());
        float least = never;
        for (std::size_t i = members_.size(); i-- > 0;)
            least_[i] = least = std::min(least, members_[i]->next);
        float most = -never;
        for (std::size_t first = 0, i = 0; i < members_.size(); ++i) {
            most = std::max(most, members_[i]->next);
            if (i + 1 < members_.size() && most > least_[i + 1])
                continue;
            if (i > first)
                crossWindow(first, i + 1, y);
            first = i + 1;
        }
    }
    for (Active* a : members_)
        a->x = a->next;
    line_ = y;
}

/// Through the crossings of members that end in another order.
void BandSweep::crossWindow(std::size_t first, std::size_t end, float y) {
    if (mayReorderMembers(first, end))
        return reorderMembers(first, end, y);
    if (end - first > fewMembers) {
        if (crossWithoutQuiet(first, end, y))
            return;
        if (areManyCrossings(first, end))
            return sortRoughly(first, end, y);
    }
    cross(first, end, y);
}

bool BandSweep::mayReorderMembers(std::size_t first, std::size_t end) {
    const std::span chains = std::span(members_).subspan(first, end - first);
    openWindow(chains);
    return isQuiet(chains, regionLeftOf(first),
                   [](const Active& a, const Active& b) { return a.next <= b.next; });
}

/// Of an open window.
void BandSweep::reorderMembers(std::size_t first, std::size_t end, float y) {
    keepState(first);
    sortStably(members_.begin() + std::ptrdiff_t(first), members_.begin() + std::ptrdiff_t(end), isLeftNext);
    relabel(first, end, y);
    steps_ += 2 * (end - first);
}

/// Through the crossings of a window of many chains of one layer, without those that are quiet
/// (quiet_chains.hpp): they show nothing, and neither do others where they cross them. False where that saves
/// nothing, or too much crosses.
bool BandSweep::crossWithoutQuiet(std::size_t first, std::size_t end, float y) {
    const std::uint32_t layer = members_[first]->layer;
    const std::int32_t base = members_[first]->before;
    const std::span window = std::span(members_).subspan(first, end - first);
    if (state_.isEvenOdd(layer) ||
        std::ranges::any_of(window, [&](const Active* a) { return a->layer != layer; }))
        return false;
    const Region left = regionLeftOf(first);
    const std::uint64_t keyLeft = keyLeftOf(first);
    // Inside and outside must be known, since the state cannot go where chains are set aside.
    const std::int32_t across = base == 0 ? 1 : -base;
    if (!state_.known(state_.keyAfter(keyLeft, layer, base, across))) {
        crossMembers(first);
        state_.cross(layer, across);
        state_.region();
        state_.cross(layer, -across);
    }
    reaching_.clear();
    for (const Active* a : window)
        reaching_.push_back({std::min(a->x, a->next), std::max(a->x, a->next), a->winding});
    quiet_.find(reaching_, base);
    if (2 * quiet_.count() < window.size())
        return false;

    keepState(first);
    aside_.assign(members_.begin(), members_.end());
    members_.clear();
    std::int32_t quietWinding = 0;
    for (std::size_t i = 0; i < reaching_.size(); ++i) {
        Active* const a = aside_[first + i];
        if (quiet_.isQuiet(i)) {
            quietWinding += a->winding;
            continue;
        }
        quietLefts_.push_back(quietWinding);
        a->before -= quietWinding;
        members_.push_back(a);
    }
    const bool isTooMuch = members_.size() > fewMembers && areManyCrossings(0, members_.size());
    if (isTooMuch) {
        for (std::size_t i = 0; i < members_.size(); ++i)
            members_[i]->before += quietLefts_[i];
    } else if (members_.size() > 1) {
        const Region outerLeft = std::exchange(leftRegion_, left);
        const std::uint64_t outerKey = std::exchange(leftKey_, keyLeft);
        isQuietAside_ = true;
        cross(0, members_.size(), y);
        isQuietAside_ = false;
        leftRegion_ = outerLeft;
        leftKey_ = outerKey;
    }
    quietLefts_.clear();
    members_.swap(aside_);
    if (isTooMuch)
        return false;
    reorderMembers(first, end, y);
    return true;
}

/// Whether more than `maxCrossings` a member.
bool BandSweep::areManyCrossings(std::size_t first, std::size_t end) {
    sorted_.clear();
    for (std::size_t i = first; i < end; ++i)
        sorted_.push_back(members_[i]->next);
    return hasMoreInversions(sorted_, merging_, maxCrossings * (end - first));
}

/// Through all crossings of some members. Each puts one pair into the order at y, so that their number is
/// bounded whatever the roundings.
void BandSweep::cross(std::size_t first, std::size_t end, float y) {
    const float height = y - line_;
    const std::size_t pairs = end - first - 1;
    const auto meet = [&](std::size_t i) {
        const Active &a = *members_[first + i], &b = *members_[first + i + 1];
        if (a.next <= b.next)
            return never;
        const float above = std::max(b.x - a.x, 0.0f), below = a.next - b.next;
        return above / (above + below) * height;
    };
    meets_.assign(pairs, meet);
    float reached = 0;
    while (meets_.least() != never) {
        limits::check();
        const std::size_t at = meets_.indexOfLeast();
        reached = std::max(reached, meets_.least());
        swap(first + at, std::min(line_ + reached, y));
        for (std::size_t i = at == 0 ? 0 : at - 1; i <= std::min(at + 1, pairs - 1); ++i)
            meets_.set(i, meet(i));
        steps_ += 4;
    }
}

/// Down to y where too much crosses: in steps, in each of which members are in their order at its middle.
void BandSweep::sortRoughly(std::size_t first, std::size_t end, float y) {
    const auto begin = members_.begin() + std::ptrdiff_t(first),
               stop = members_.begin() + std::ptrdiff_t(end);
    const float height = std::max(thinnest_, (y - line_) / 256);
    const auto sortAt = [&](float at, float since) {
        limits::check();
        for (auto a = begin; a != stop; ++a)
            (*a)->x = (*a)->xAt(at);
        keepState(first);
        openWindow(std::span(members_).subspan(first, end - first));
        sortStably(begin, stop, isLeftThere);
        relabel(first, end, since);
        steps_ += 8 * (end - first);
    };
    for (float top = line_; top < y; top += height)
        sortAt(0.5f * (top + std::min(top + height, y)), top);
    sortAt(y, y);
}

/// What the key on its left becomes on a member's right.
std::uint64_t BandSweep::keyRightOf(const Active& member, std::uint64_t keyLeft, float y) const {
    if (!isQuietAside_)
        return state_.keyAfter(keyLeft, member.layer, member.before, member.winding);
    const std::optional<std::int32_t> quiet = quiet_.windingLeftOf(member.xAt(y));
    return quiet ? state_.keyAfter(keyLeft, member.layer, member.before + *quiet, member.winding) : keyLeft;
}

/// Members `at` and at + 1 cross. Only the region between them changes.
void BandSweep::swap(std::size_t at, float y) {
    keepState(at);
    Active &a = *members_[at], &b = *members_[at + 1];
    if (a.layer == b.layer) {
        b.before = a.before;
        a.before = b.before + b.winding;
    }
    const std::uint64_t keyRight = b.key, keyLeft = keyLeftOf(at);
    const Region right = b.region, left = regionLeftOf(at);
    b.key = keyRightOf(b, keyLeft, y);
    a.key = keyRight;
    a.region = right;
    std::swap(members_[at], members_[at + 1]);
    Active &first = b, &second = a;
    first.region = first.key == keyRight ? right : regionAfter(at, left, keyLeft);
    setSides(first, left.paint, first.region.paint, y);
    setSides(second, first.region.paint, right.paint, y);
}

}  // namespace vtm::compiler

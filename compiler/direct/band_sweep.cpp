#include "compiler/direct/band_sweep.hpp"

#include <algorithm>
#include <cmath>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/inversions.hpp"
#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

using asset::bandRows;

/// Slabs grow to so many rows where nothing happens.
constexpr float mostHeight = 4;
/// And a slab costs as much as so many steps besides.
constexpr std::size_t slabSteps = 500;

/// A strip in which sweeping takes more, or more a row, is passed on, and so it is where a slab
/// would take more and cannot be made thinner (or twice as much, unless it has many short chains, and in the
/// thinnest slabs all of it takes less); so does one that remembers too many programs.
constexpr std::size_t mostInStrip = 1u << 22, mostInRow = 1u << 19, mostInSlab = 1u << 23,
                      mostInThinnest = 1u << 21;
/// So does one that begins with more chains, of so many layers that some may hide others: a row could look at
/// them only a few times. Chains of few layers may not cross at all.
constexpr std::size_t mostAtOnce = 1u << 17, manyLayers = 64;
/// Where there are only colours, that takes so many times less.
constexpr std::size_t sampledShare = 4;
/// A region that is not known costs as much as so many steps, and one more for so many layers.
constexpr std::size_t regionSteps = 8, layersInStep = 4;
/// So many chains that the state crosses are a step: as long as it takes only where there are other ways.
constexpr std::size_t crossedInStep = 8, fewCrossedInStep = 2;
/// A chord of a program costs as much as so many steps.
constexpr std::size_t programSteps = 2;
/// Then the next band is tried again if it has fewer chains than this, or half as many as before; else the
/// next strip.
constexpr std::size_t fewToBegin = 1u << 15;

/// So many edges are tangled if each crosses two others within a row; of more than so many even their single
/// pixels would take too much.
constexpr std::size_t fewTangled = 1024, manyTangled = 1u << 15;

/// Where the line from a down to b is at y.
float xBetween(glm::vec2 a, glm::vec2 b, float y) {
    return y >= b.y ? b.x : y <= a.y ? a.x : a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y));
}

}  // namespace

BandSweep::BandSweep(const LoweredScene& picture, const ViewChains& chains, RegionState& state,
                     PixelColors& pixels, int width)
    : chains_(chains),
      vertices_(chains.vertices()),
      state_(state),
      outline_(chains, state, width),
      lines_(chains, state, pixels, width),
      mostInSlab_(mostInSlab),
      crossedInStep_(crossedInStep),
      windings_(picture.layers.size()) {
    if (!state.hasOnlyColors())
        return;
    sampled_.emplace(picture, chains, state, width);
    share_ = sampledShare;
    crossedInStep_ = fewCrossedInStep;
    mostInSlab_ /= share_;
}

void BandSweep::run(int band, bool begins, std::vector<asset::Chord>& chords) {
    chords_ = &chords;
    const auto top = float(band * bandRows), bottom = float((band + 1) * bandRows);
    const std::span<const std::uint32_t> chains = chains_.inBand(band);
    const auto firstBelow =
        std::ranges::find_if(chains, [&](std::uint32_t c) { return chains_[c].top >= top; });
    const auto above = std::size_t(firstBelow - chains.begin());
    if (begins) {
        // What a sweep costs, and so how it goes, must not depend on what the thread has drawn before.
        state_.forgetRegions();
        passedOn_ = 0;
        stripSteps_ = 0;
        stripTop_ = top;
        releaseAll();
        if (above > mostAtOnce && windings_.size() >= manyLayers)
            passedOn_ = chains.size();
    }
    if (state_.remembersMuch() || (passedOn_ > fewToBegin && 2 * chains.size() > passedOn_))
        return passOn(chains, top, bottom);
    const bool beginsHere = begins || isPassedOver_ || passedOn_ > 0 || chains_.areLeftOut();
    if (beginsHere)
        begin(chains.first(above), top);
    const bool isTangled = this->isTangled(top);
    if (isTangled && sorted_.size() > manyTangled && sampled_)
        return passOn(chains, top, bottom);
    isPassedOver_ = isTangled && outline_.draw(chains, top, bottom, chords);
    if (isPassedOver_)
        return leave(top);
    passedOn_ = 0;
    toCome_ = chains.subspan(above);
    const std::size_t chordsBefore = chords.size();
    const auto giveUp = [&](float y) {
        // In thin slabs a sweep of so much is not exact either: of a row that took too much nothing is kept.
        if (sampled_ && beginsHere && y <= top + 1) {
            chords.resize(chordsBefore);
            moveState(0);
            passedOn_ = chains.size();
            y = top;
        }
        passOn(chains, y, bottom);
    };
    for (float y = top; y < bottom;) {
        limits::check();
        steps_ = 0;
        thinnest_ = std::max(leastHeight, float(active_.size()) / looksInRow);
        if (state_.remembersMuch() || stripSteps_ > mayTake(y))
            return giveUp(y);
        if (!slab({y, y + height_})) {
            if (!mayBeThinner(y))
                return giveUp(y);
            height_ *= 0.5f;
            stripSteps_ += active_.size() + events_.size();
            continue;
        }
        stripSteps_ += steps_ + active_.size();
        y += height_;
        const std::size_t looks = active_.size() + slabSteps;
        if (steps_ > 2 * looks && height_ >= 2 * thinnest_)
            height_ *= 0.5f;
        else if (steps_ < looks / 2 && height_ < mostHeight && std::fmod(y - top, 2 * height_) == 0)
            height_ *= 2;
    }
    for (Active* a : active_) {
        draw(*a, a->from, bottom);
        a->from = bottom;
    }
    moveState(0);
}

/// Steps of the strip down to y.
std::size_t BandSweep::mayTake(float y) const {
    return (mostInStrip + std::size_t(y - stripTop_) * mostInRow) / share_;
}

/// Whether a slab from y on that would take too much is to be halved. In half of the height it takes a
/// quarter, and there are twice as many looks: that is much less where most of the chains are short.
bool BandSweep::mayBeThinner(float y) const {
    if (height_ < 2 * thinnest_)
        return false;
    if (wouldTake_ <= 2 * mostInSlab_)
        return true;
    const auto endsBelow = [&](std::uint32_t chain) { return chains_[chain].bottom > y + height_; };
    const std::size_t chains = active_.size() + beginning_.size(),
                      longer = active_.size() + std::size_t(std::ranges::count_if(beginning_, endsBelow));
    const double slabs = double(height_ / thinnest_);
    return 4 * longer < chains && double(wouldTake_) / slabs + double(chains) * slabs < mostInThinnest;
}

/// Whether many edges of those that are seen cross within a row.
bool BandSweep::isTangled(float y) {
    if (active_.size() < fewTangled)
        return false;
    sorted_.clear();
    for (const Active* a : active_)
        if (!state_.isSame(a->drawn[0], a->drawn[1]))
            sorted_.push_back(a->xAt(y + 1));
    return sorted_.size() >= fewTangled && hasMoreInversions(sorted_, merging_, sorted_.size());
}

/// Draws what comes from above.
void BandSweep::leave(float y) {
    for (const Active* a : active_)
        draw(*a, a->from, y);
    moveState(0);
}

/// The rest of the band is drawn without following what happens: at places, or in level steps.
void BandSweep::passOn(std::span<const std::uint32_t> chains, float top, float bottom) {
    if (passedOn_ == 0) {
        leave(top);
        passedOn_ = chains.size();
    }
    if (sampled_ && !lines_.isDrawnByContent(chains, top))
        sampled_->run(chains, top, bottom, *chords_);
    else
        lines_.run(chains, top, bottom, *chords_);
}

// ---- Chains ---------------------------------------------------------------------------------------

BandSweep::Active* BandSweep::activate(std::uint32_t number) {
    const DownChain& chain = chains_[number];
    if (free_.empty())
        free_.push_back(&pool_.emplace_back());
    Active& a = *free_.back();
    free_.pop_back();
    a = {};
    a.at = chain.first;
    a.end = chain.end;
    a.layer = chain.layer;
    a.winding = chain.winding;
    a.b = vertices_[chain.first];
    --a.at;
    nextEdge(a);
    ++windings_[a.layer].chains;
    return &a;
}

void BandSweep::release(Active& active) {
    --windings_[active.layer].chains;
    free_.push_back(&active);
}

void BandSweep::releaseAll() {
    for (Active* a : active_)
        release(*a);
    active_.clear();
}

/// Goes on to the next edge that is not level, if there is one.
bool BandSweep::nextEdge(Active& active) const {
    do {
        ++active.at;
        if (active.at + 1 >= active.end)
            return false;
        active.a = vertices_[active.at];
        active.b = vertices_[active.at + 1];
    } while (active.a.y == active.b.y);
    active.slope = (active.b.x - active.a.x) / (active.b.y - active.a.y);
    return true;
}

/// With chains that the band's top cuts.
void BandSweep::begin(std::span<const std::uint32_t> chains, float top) {
    releaseAll();
    height_ = 1;
    members_.clear();
    for (const std::uint32_t chain : chains) {
        if (chains_[chain].bottom <= top)
            continue;
        Active& a = *activate(chain);
        while (a.b.y <= top)
            nextEdge(a);
        a.x = a.next = a.xAt(top);
        a.from = top;
        members_.push_back(&a);
    }
    sortStably(members_.begin(), members_.end(), isLeft);
    done_.clear();
    enterSweep();
    label(top);
    keepState(0);
    active_.swap(members_);
}

// ---- Slabs ----------------------------------------------------------------------------------------

/// False if that is too much; then nothing is done.
bool BandSweep::slab(Slab slab) {
    std::size_t count = 0;
    while (count < toCome_.size() && chains_[toCome_[count]].top < slab.bottom)
        ++count;
    beginning_.assign(toCome_.begin(), toCome_.begin() + std::ptrdiff_t(count));
    look(slab);
    lookAtBeginning(slab);
    wouldTake_ = gather() ? stepsOfGroups(slab.bottom) : std::numeric_limits<std::size_t>::max();
    if (wouldTake_ > mostInSlab_) {
        for (Active* a : active_)  // where look() finds them again
            a->next = a->x;
        return false;
    }
    toCome_ = toCome_.subspan(count);
    state_.forgetManyRegions();
    sweepGroups(slab);
    return true;
}

/// Where the chains go. Events are ends, and neighbours that are not ordered.
void BandSweep::look(Slab slab) {
    events_.clear();
    bent_.clear();
    columns_.resize(active_.size());
    float rightBefore = -never;
    for (std::size_t i = 0; i < active_.size(); ++i) {
        Active& a = *active_[i];
        a.x = a.next;
        a.isBent = a.b.y <= slab.bottom;
        Columns columns;
        if (a.isBent) {
            columns = lookAt(a, i, slab.bottom);
        } else {
            a.next = a.xAt(slab.bottom);
            columns = {std::min(a.x, a.next), std::max(a.x, a.next)};
        }
        columns_[i] = columns;
        if (rightBefore > columns.left && !isOrdered(*active_[i - 1], a, slab.bottom))
            events_.push_back({std::min(columns_[i - 1].left, columns.left),
                               std::max(rightBefore, columns.right), i - 1, i + 1, noIndex, true});
        rightBefore = columns.right;
    }
}

/// One that has a vertex above the bottom.
BandSweep::Columns BandSweep::lookAt(Active& active, std::size_t number, float bottom) {
    bent_.push_back(number);
    Reach reach;
    reach.add(active.x);
    addReach(reach, active.at + 1, active.end, bottom);
    active.next = reach.last;
    active.bends = reach.bends;
    if (reach.ends)
        events_.push_back({reach.left, reach.right, number, number + 1, noIndex, false});
    return reach;
}

/// From vertex `at` of a chain on, down to the bottom.
void BandSweep::addReach(Reach& reach, std::uint32_t at, std::uint32_t end, float bottom) const {
    for (; at < end && vertices_[at].y <= bottom; ++at, ++reach.bends)
        reach.add(vertices_[at].x);
    reach.ends = at == end;
    if (!reach.ends)
        reach.add(xBetween(vertices_[at - 1], vertices_[at], bottom));
}

/// Whether no point of the left one, from the line to the bottom, is on the right of the other; it may say no
/// where both are level.
bool BandSweep::isOrdered(const Active& left, const Active& right, float bottom) const {
    if (left.next > right.next)
        return false;
    if (!left.isBent && !right.isBent)
        return true;
    std::uint32_t i = left.at + 1, k = right.at + 1;
    const auto xAt = [&](std::uint32_t at, float y) { return xBetween(vertices_[at - 1], vertices_[at], y); };
    while (i < left.end && k < right.end) {
        const glm::vec2 p = vertices_[i], q = vertices_[k];
        if (p.y > bottom && q.y > bottom)
            return true;
        if (p == q) {
            ++i;
            ++k;
        } else if (p.y <= q.y) {
            if (p.x > xAt(k, p.y))
                return false;
            ++i;
        } else {
            if (xAt(i, q.y) > q.x)
                return false;
            ++k;
        }
    }
    return true;
}

void BandSweep::lookAtBeginning(Slab slab) {
    for (const std::uint32_t number : beginning_) {
        Reach reach;
        addReach(reach, chains_[number].first, chains_[number].end, slab.bottom);
        events_.push_back({reach.left, reach.right, active_.size(), 0, number, false, reach.bends});
    }
}

/// The chains near events. False if looking for them is too much.
bool BandSweep::gather() {
    sortStably(events_.begin(), events_.end(),
               [](const Event& a, const Event& b) { return a.left < b.left; });
    groups_.clear();
    std::size_t from = 0, looks = 0;
    for (Event event : events_) {
        // The ends of shadows ascend, but for those of chains that cross, which are events themselves.
        while (from < columns_.size() && columns_[from].right < event.left)
            ++from;
        event.first = std::min(from, event.first);
        event.end = std::max(event.first, event.end);
        while (event.end < columns_.size() && columns_[event.end].left <= event.right)
            ++event.end;
        looks += event.end - event.first;
        if (looks > mostInSlab_)
            return false;
        if (groups_.empty() || (event.first >= groups_.back().end && event.left > groups_.back().right)) {
            groups_.push_back(event);
            continue;
        }
        Event& group = groups_.back();
        group.first = std::min(group.first, event.first);
        group.end = std::max(group.end, event.end);
        group.right = std::max(group.right, event.right);
        group.isCrossing = group.isCrossing && event.isCrossing;
        group.bends += event.bends;
    }
    return true;
}

/// Of sweeping the groups from vertex to vertex, about.
std::size_t BandSweep::stepsOfGroups(float bottom) {
    std::size_t steps = 0;
    for (const Event& group : groups_) {
        const std::size_t members = group.end - group.first + group.bends;
        std::size_t bends = group.bends;
        for (std::size_t i = group.first; i < group.end; ++i)
            bends += active_[i]->isBent ? active_[i]->bends : 0;
        if (bends * members > mostInSlab_)
            bends = heights(group, bottom);
        steps += bends * members;
    }
    return steps;
}

/// At how many heights a group has vertices.
std::size_t BandSweep::heights(const Event& group, float bottom) {
    sorted_.clear();
    const auto add = [&](std::uint32_t at, std::uint32_t end) {
        for (; at < end && vertices_[at].y <= bottom; ++at)
            sorted_.push_back(vertices_[at].y);
    };
    for (std::size_t i = group.first; i < group.end; ++i)
        add(active_[i]->at + 1, active_[i]->end);
    for (const Event& event : events_)
        if (event.begins != noIndex && event.left >= group.left && event.left <= group.right)
            add(chains_[event.begins].first, chains_[event.begins].end);
    std::ranges::sort(sorted_);
    return std::size_t(std::ranges::unique(sorted_).begin() - sorted_.begin());
}

/// And lets all others pass.
void BandSweep::sweepGroups(Slab slab) {
    std::size_t bent = 0;
    if (groups_.empty())
        return pass(active_.size(), bent, slab.bottom);
    // Up to the first group the chains stay what they are.
    if (crossedDone_.size() > groups_[0].first)
        moveState(groups_[0].first);
    done_.clear();
    std::size_t passed = 0, nextEvent = 0;
    const auto passTo = [&](std::size_t end) {
        done_.insert(done_.end(), active_.begin() + std::ptrdiff_t(passed),
                     active_.begin() + std::ptrdiff_t(end));
        pass(end, bent, slab.bottom);
        passed = end;
    };
    for (const Event& group : groups_) {
        passTo(group.first);
        starting_.clear();
        for (; nextEvent < events_.size() && events_[nextEvent].left <= group.right; ++nextEvent)
            if (events_[nextEvent].begins != noIndex)
                starting_.push_back(events_[nextEvent].begins);
        members_.assign(active_.begin() + std::ptrdiff_t(group.first),
                        active_.begin() + std::ptrdiff_t(group.end));
        enterSweep();
        if (group.isCrossing && mayReorder(slab))
            reorder(slab);
        else
            sweep(slab);
        done_.insert(done_.end(), members_.begin(), members_.end());
        passed = group.end;
        while (bent < bent_.size() && bent_[bent] < passed)
            ++bent;
    }
    passTo(active_.size());
    active_.swap(done_);
}

/// Nothing happens to chains up to `end`. `bent`: of bent_, the next one.
void BandSweep::pass(std::size_t end, std::size_t& bent, float bottom) {
    for (; bent < bent_.size() && bent_[bent] < end; ++bent)
        passBends(*active_[bent_[bent]], bottom);
}

void BandSweep::passBends(Active& active, float bottom) {
    while (active.b.y <= bottom) {
        draw(active, active.from, active.b.y);
        active.from = active.b.y;
        nextEdge(active);
    }
}

// ---- Paints ---------------------------------------------------------------------------------------

/// On the right of a member, whose key is set.
Region BandSweep::regionAfter(std::size_t at, const Region& left, std::uint64_t keyLeft) {
    const Active& member = *members_[at];
    if (member.key == keyLeft || state_.isHidden(member.layer, left))
        return left;
    if (const Region* region = state_.known(member.key))
        return *region;
    crossMembers(at + 1);
    const std::size_t before = state_.composited();
    const Region& region = state_.region();
    stripSteps_ += regionSteps + (state_.composited() - before) / layersInStep;
    return region;
}

/// Takes the state to the right of so many members.
void BandSweep::crossMembers(std::size_t count) {
    moveState(done_.size());
    keepState(count);
    steps_ += (count - crossedMembers_.size()) / crossedInStep_;
    while (crossedMembers_.size() < count) {
        const Active& a = *members_[crossedMembers_.size()];
        state_.cross(a.layer, a.winding);
        crossedMembers_.push_back({a.layer, a.winding});
    }
}

/// Takes the state back to the left of the member with that number.
void BandSweep::keepState(std::size_t members) {
    if (crossedMembers_.size() > members)
        steps_ += (crossedMembers_.size() - members) / crossedInStep_;
    for (; crossedMembers_.size() > members; crossedMembers_.pop_back())
        state_.cross(crossedMembers_.back().layer, -crossedMembers_.back().winding);
}

/// Moves it to the right of so many chains that are done.
void BandSweep::moveState(std::size_t done) {
    if (crossedDone_.size() == done)
        return;
    keepState(0);
    steps_ += (std::max(crossedDone_.size(), done) - std::min(crossedDone_.size(), done)) / crossedInStep_;
    for (; crossedDone_.size() > done; crossedDone_.pop_back())
        state_.cross(crossedDone_.back().layer, -crossedDone_.back().winding);
    while (crossedDone_.size() < done) {
        const Active& a = *done_[crossedDone_.size()];
        state_.cross(a.layer, a.winding);
        crossedDone_.push_back({a.layer, a.winding});
    }
}

void BandSweep::setSides(Active& active, RegionPaint left, RegionPaint right, float y) {
    if (state_.isSame(active.drawn[0], left) && state_.isSame(active.drawn[1], right))
        return;
    draw(active, active.from, y);
    active.drawn[0] = left;
    active.drawn[1] = right;
    active.from = y;
}

void BandSweep::draw(const Active& active, float from, float to) {
    if (state_.isSame(active.drawn[0], active.drawn[1]) || from >= to)
        return;
    chords_->push_back({{active.xAt(from), from}, {active.xAt(to), to}, active.drawn[0], active.drawn[1]});
    if (((active.drawn[0] | active.drawn[1]) & programBit) != 0)
        stripSteps_ += programSteps;
}

}  // namespace vtm::compiler

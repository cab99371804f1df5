#include "compiler/direct/line_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

/// Chains in smaller steps, a band: what they may cost.
constexpr std::size_t smallCutsInBand = 16 * 100'000;
/// A region that is composited in a pixel costs as much as so many chains.
constexpr double pixelCost = 8;
/// And a layer that is composited for a region as much as this part of one.
constexpr double layerCost = 1.0 / 16;
/// What shows is asked for no more often than so, in columns: chains that are nearer to the last one at which
/// it was asked are crossed together.
constexpr float nearChains = 1.0f / 512;
/// A chain so near to a pixel may be in it.
constexpr float nearPixel = 1.0f / 64;
/// Chains near those that begin, end or are nearly level take so many steps instead of one, at most.
constexpr int mostSmallSteps = 1024;

/// Where so many chains are cut, or more, of so many layers, those are looked for that are hidden in a step.
constexpr std::size_t manyCuts = 1u << 10, manyLayers = 64;
/// If fewer than one of so many chains are hidden, nobody looks in the rest of the row and in so many more.
constexpr std::size_t hiddenOfOthers = 8;
constexpr int rowsToTryAgain = 7;
/// On a row of squares so many to a pixel.
constexpr std::int32_t squaresInAPixel = 16;

/// Chains that meet a row, in the mean.
double meanCutOf(const ViewChains& chains) {
    const double rows = double(chains.bands()) * asset::bandRows;
    double cut = 0;
    for (const DownChain& chain : chains.all())
        cut += std::min(double(chain.bottom), rows) - std::max(double(chain.top), 0.0) + 1;
    return cut / rows;
}

/// Edges that are misplaced in a step may cover more than there is of a pixel: then their shares of it.
glm::vec4 withinAPixel(const glm::vec4& color) { return color.a > 1 ? color / color.a : color; }

/// Whether each is where its number says.
bool isInOrder(std::span<const Placed> order) {
    for (std::uint32_t i = 0; i < order.size(); ++i)
        if (order[i].number != i)
            return false;
    return true;
}

template <class T>
void arrange(const std::vector<T>& items, std::span<const Placed> order, std::vector<T>& arranged) {
    arranged.clear();
    for (const Placed& p : order)
        arranged.push_back(items[p.number]);
}

}  // namespace

LineSweep::LineSweep(const ViewChains& chains, RegionState& state, PixelColors& pixels, int width)
    : chains_(chains),
      vertices_(chains.vertices()),
      state_(state),
      pixels_(pixels),
      width_(width),
      taker_(chains),
      sums_(std::size_t(width) + 2),
      shares_(sums_.size()),
      pixelSums_(sums_.size()),
      squares_(width * squaresInAPixel) {}

void LineSweep::run(std::span<const std::uint32_t> numbers, float top, float bottom,
                    std::vector<asset::Chord>& chords) {
    chords_ = &chords;
    begin(numbers);
    while (top < bottom) {
        const float end = std::min(std::floor(top) + 1, bottom);
        row(top, end);
        top = end;
    }
    state_.preferDeep(false);
}

bool LineSweep::isDrawnByContent(std::span<const std::uint32_t> numbers, float top) {
    const float bottom = std::floor(top) + 1;
    begin(numbers);
    take(top, bottom);
    findPieces(top, bottom);
    steps_.clear();
    return placeByContent(top, bottom, stepsInRow());
}

void LineSweep::begin(std::span<const std::uint32_t> numbers) {
    if (meanCut_ == 0 && !numbers.empty()) {
        meanCut_ = meanCutOf(chains_);
        isOneLayer_ = std::ranges::all_of(chains_.all(), [&](const DownChain& chain) {
            return chain.layer == chains_.all().begin()->layer;
        });
        if (isOneLayer_)
            lookInside(chains_[numbers[0]]);
    }
    cuts_.clear();
    taker_.begin(numbers);
    smallInBand_ = smallCutsInBand;
    costOfCut_ = 1;
    isMeasured_ = isOneColor_;
    rowsShown_ = 0;
    endCuts_ = endCutsInBand;
}

/// What a chain costs with the pixels that a step of the row asks for, and the layers that it composites.
void LineSweep::measure(float top, float bottom) {
    isMeasured_ = true;
    pixelsAsked_ = regionsAsked_ = 0;
    smallSteps_ = endCutsInStep_ = 0;
    const std::size_t before = state_.composited();
    drawn_ = top;
    // What is hidden in parts of the row is not hidden in all of it.
    const bool hides = hides_;
    const int rowsShown = rowsShown_;
    draw({top, bottom, bottom - top});
    hides_ = hides;
    rowsShown_ = rowsShown;
    std::ranges::fill(sums_, glm::vec4(0));
    std::ranges::fill(pixelSums_, glm::vec4(0));
    const std::size_t composited = state_.composited() - before;
    costOfCut_ +=
        (pixelCost * double(pixelsAsked_) + layerCost * double(composited)) / double(cuts_.size() + 1);
    state_.preferDeep(state_.isDeep(composited / (regionsAsked_ + 1)));
    if (isInPixels_)
        smallInBand_ = std::size_t(double(smallCutsInBand) / costOfCut_);
}

/// Of the only layer, which the chain is of.
void LineSweep::lookInside(const DownChain& chain) {
    isEvenOdd_ = state_.isEvenOdd(chain.layer);
    state_.cross(chain.layer, chain.winding);
    const RegionPaint paint = state_.region().paint;
    state_.cross(chain.layer, -chain.winding);
    isOneColor_ = (paint & programBit) == 0;
    if (isOneColor_)
        color_ = state_.colors()[paint];
}

void LineSweep::row(float top, float bottom) {
    take(top, bottom);
    hides_ = rowsShown_ == 0 && mayHide();
    rowsShown_ = std::max(rowsShown_ - 1, 0);
    remembers_ = state_.hasPrograms() && !state_.remembersMuch();
    isInPixels_ = state_.hasPrograms() && !remembers_;
    if (isInPixels_)
        findLayersOfPixels(top, bottom);
    if (!isMeasured_ && (isInPixels_ || (!remembers_ && cuts_.size() >= manyCuts)))
        measure(top, bottom);
    const bool isByContent = findSteps(top, bottom);
    // A step may take several times its share of what the band may.
    auto stepsLeft = std::size_t(asset::bandRows - std::fmod(top, float(asset::bandRows))) * steps_.size();
    const std::size_t share = 8 * smallInBand_ / std::max<std::size_t>(stepsLeft, 1);
    drawn_ = top;
    for (const Step& step : steps_) {
        const std::size_t may = isByContent ? 0 : std::min(share, smallInBand_);
        smallSteps_ = may;
        endCutsInStep_ = endCuts_ / std::max<std::size_t>(stepsLeft, 1);
        stepsLeft -= stepsLeft > 0;
        draw(step);
        smallInBand_ -= may - smallSteps_;
    }
    finishRow(top, bottom);
}

// ---- Chains ---------------------------------------------------------------------------------------

void LineSweep::take(float top, float bottom) {
    const auto merge = [&](const auto& isBefore) {
        taker_.take(
            top, bottom, cuts_, [](const DownChain&) { return true; }, isBefore);
    };
    if (isOneLayer_)
        merge([&](const CutChain& a, const CutChain& b) { return a.xAt(top) < b.xAt(top); });
    else
        merge([](const CutChain& a, const CutChain& b) { return a.layer > b.layer; });
}

/// Where the edge that was looked at last does not reach from the top to the bottom.
void LineSweep::lookAgain(CutChain& cut, const Step& step, Seen& seen) {
    findEdge(cut, step.top, vertices_);
    if (cut.spans(step.top, step.bottom) && cut.a.y < cut.edgeBottom)
        return look(seen.cut, step, seen);
    lookAround(cut, step, seen);
}

/// Where it has a vertex. Above its upper end and below its lower one it is taken to be there.
void LineSweep::lookAround(const CutChain& cut, const Step& step, Seen& seen) {
    const auto xAt = [&](const glm::vec2* edge, float y) {
        return edge[0].x + (y - edge[0].y) * ((edge[1].x - edge[0].x) / (edge[1].y - edge[0].y));
    };
    const glm::vec2* edge = vertices_ + cut.at;
    const glm::vec2 *const first = edge, *const last = vertices_ + cut.last;
    const float middle = step.middle();
    seen.from = edge->y < step.top && edge[1].y > step.top ? xAt(edge, step.top) : edge->x;
    if (edge[1].y <= step.top)
        seen.from = edge[1].x;
    seen.x = seen.to = seen.left = seen.right = seen.from;
    for (; edge < last && edge->y < step.bottom; ++edge) {
        if (edge->y <= middle && edge[1].y > middle)
            seen.x = xAt(edge, middle);
        else if (edge[1].y <= middle)
            seen.x = edge[1].x;
        seen.to = edge[1].y > step.bottom ? xAt(edge, step.bottom) : edge[1].x;
        if (edge->y >= step.top || edge == first) {
            seen.left = std::min(seen.left, seen.to);
            seen.right = std::max(seen.right, seen.to);
        }
    }
    // What has been left behind is above the step.
    const float begins = first->y, ends = edge == last ? last->y : INFINITY;
    seen.isAtMiddle = begins <= middle && middle < ends;
    seen.hasEnd = begins > step.top || ends < step.bottom;
    seen.isSpecial =
        begins < step.bottom && ends > step.top && (seen.hasEnd || seen.right - seen.left > mostReach);
    hasSpecial_ = hasSpecial_ || seen.isSpecial;
}

// ---- What shows -----------------------------------------------------------------------------------

bool LineSweep::mayHide() const {
    if (cuts_.size() < manyCuts)
        return false;
    std::size_t layers = 1;
    for (std::size_t i = 1; i < cuts_.size() && layers < manyLayers; ++i)
        layers += cuts_[i].layer != cuts_[i - 1].layer;
    return layers >= manyLayers;
}

void LineSweep::lookAtAll(const Step& step) {
    seen_.resize(cuts_.size());
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
        fetchAhead(cuts_, i, step.bottom, vertices_);
        look(i, step, seen_[i]);
    }
    if (order_.size() == seen_.size()) {  // as in the step before, and nearly in order
        for (Placed& p : order_)
            p.x = seen_[p.number].x;
        return;
    }
    order_.clear();
    for (const Seen& seen : seen_)
        order_.push_back({seen.x, seen.cut});
}

/// Those of layers that are not hidden.
void LineSweep::lookForShown(const Step& step) {
    seen_.clear();
    squares_.clear();
    bool isRowHidden = false;
    for (std::size_t i = 0; i < cuts_.size();) {
        const std::uint32_t layer = cuts_[i].layer;
        const bool isPassedOver = isRowHidden && state_.cover(layer).mayBeHidden;
        const std::size_t before = seen_.size();
        for (; i < cuts_.size() && cuts_[i].layer == layer; ++i) {
            if (isPassedOver)
                continue;
            fetchAhead(cuts_, i, step.bottom, vertices_);
            look(i, step, seen_.emplace_back());
        }
        if (isPassedOver || isShown(std::span(seen_).subspan(before)))
            continue;
        seen_.erase(seen_.begin() + std::ptrdiff_t(before), seen_.end());
        isRowHidden = isRowHidden || squares_.isHidden();
    }
    order_.clear();
    for (const Seen& seen : seen_)
        order_.push_back({seen.x, std::uint32_t(order_.size())});
}

/// Chains that begin, end or are nearly level in the step show if they do anywhere in it.
bool LineSweep::isShown(std::span<const Seen> ofLayer) {
    const std::uint32_t layer = ofLayer[0].layer;
    const LayerCover& cover = state_.cover(layer);
    if (!cover.mayBeHidden)
        return true;
    const auto square = [&](float x) {
        return std::clamp(std::int32_t(x * squaresInAPixel), 0, squares_.squares() - 1);
    };
    touches_.clear();
    for (const Seen& seen : ofLayer) {
        const std::int32_t winding = seen.isAtMiddle ? seen.winding : 0;
        if (!seen.isSpecial && !seen.isAtMiddle)
            continue;
        const float left = seen.isSpecial ? seen.left : seen.x, right = seen.isSpecial ? seen.right : seen.x;
        if (right <= 0)
            touches_.push_back(Touch::before(winding, seen.hasEnd));
        else if (left >= float(width_))
            touches_.push_back(Touch::behind(squares_.squares(), winding, seen.hasEnd));
        else
            touches_.push_back({square(left), square(right), winding, seen.hasEnd});
    }
    sortStably(touches_.begin(), touches_.end(),
               [](const Touch& a, const Touch& b) { return a.first < b.first; });
    auto steps = std::size_t(squares_.squares());
    return squares_.add(touches_, cover, state_.isEvenOdd(layer), steps);
}

// ---- Drawing --------------------------------------------------------------------------------------

/// Brings the chains of one layer into their order, so that steps go through memory once.
void LineSweep::arrangeCuts() {
    isArranged_ = true;
    if (isInOrder(order_))
        return;
    arrange(cuts_, order_, arranged_);
    cuts_.swap(arranged_);
    arrange(seen_, order_, sorted_);
    seen_.swap(sorted_);
    for (std::uint32_t i = 0; i < order_.size(); ++i)
        seen_[i].cut = order_[i].number = i;
}

/// Brings the chains into their order.
void LineSweep::lookAndSort(const Step& step) {
    limits::check();
    hasSpecial_ = false;
    if (hides_) {
        lookForShown(step);
        if (hiddenOfOthers * (cuts_.size() - seen_.size()) < cuts_.size()) {
            hides_ = false;
            rowsShown_ = rowsToTryAgain;
        }
    } else {
        lookAtAll(step);
    }
    sortPlaces(order_, spare_);
    if (isOneLayer_ && !isArranged_)
        arrangeCuts();
    if (isInOrder(order_))
        sorted_.swap(seen_);
    else
        arrange(seen_, order_, sorted_);
}

void LineSweep::draw(const Step& step) {
    if (!addInOrder(step))
        drawSorted(step);
    drawn_ += step.height;
}

void LineSweep::drawSorted(const Step& step) {
    lookAndSort(step);
    winding_ = 0;
    endedColumns_.clear();
    if (hasSpecial_ && mayDrawEnds())
        findEndedColumns(step);
    if (endedColumns_.empty()) {
        drawChains(step);
    } else {
        drawEndedColumns(step);  // first: chains are followed from above
        inStep_.assign(sums_.size(), glm::vec4(0));
        sums_.swap(inStep_);
        drawChains(step);
        sums_.swap(inStep_);
        for (std::size_t i = 0; i < sums_.size(); ++i)
            sums_[i] += inStep_[i];
        leaveOutEndedColumns(inStep_);
    }
}

void LineSweep::drawChains(const Step& step) {
    if (smallSteps_ > 0 && hasSpecial_)
        drawByParts(step);
    else
        cross(sorted_, step, {}, -INFINITY, INFINITY);
}

/// Chains that reach into the same columns, together.
void LineSweep::drawByParts(const Step& step) {
    leftmost_.resize(sorted_.size());
    float leftmost = INFINITY;
    for (std::size_t i = sorted_.size(); i-- > 0;)
        leftmost_[i] = leftmost = std::min(leftmost, sorted_[i].left);
    Shown left;
    float right = -INFINITY, begin = -INFINITY;
    bool hasSpecial = false;
    for (std::size_t first = 0, i = 0; i < sorted_.size(); ++i) {
        right = std::max(right, sorted_[i].right);
        hasSpecial = hasSpecial || sorted_[i].isSpecial;
        if (i + 1 < sorted_.size() && right >= leftmost_[i + 1])
            continue;
        const std::span part = std::span(sorted_).subspan(first, i + 1 - first);
        const float end = i + 1 < sorted_.size() ? leftmost_[i + 1] : INFINITY;
        if (hasSpecial && smallSteps_ > 0)
            drawInSteps(part, step, left, begin, end);
        else
            left = cross(part, step, left, begin, end);
        first = i + 1;
        begin = end;
        right = -INFINITY;
        hasSpecial = false;
    }
}

/// From left to right; from step to step they are nearly in order.
void LineSweep::lookAtPart(const Step& step) {
    for (Placed& p : partOrder_) {
        look(part_[p.number].cut, step, part_[p.number]);
        p.x = part_[p.number].x;
    }
    sortPlaces(partOrder_, spare_);
    arrange(part_, partOrder_, partSorted_);
}

/// Some of the chains in smaller steps, as many as their reach asks for and the row may take.
void LineSweep::drawInSteps(std::span<const Seen> chains, const Step& step, Shown& left, float begin,
                            float end) {
    float reach = 0;
    bool hasEnds = false;
    for (const Seen& seen : chains) {
        reach = std::max(reach, seen.right - seen.left);
        hasEnds = hasEnds || seen.hasEnd;
    }
    const auto wanted = std::clamp(int(reach / mostReach) + 1, hasEnds ? 4 : 1, mostSmallSteps);
    const auto count = int(std::min(std::size_t(wanted), smallSteps_ / chains.size()));
    if (count <= 1) {
        left = cross(chains, step, left, begin, end);
        return;
    }
    smallSteps_ -= chains.size() * std::size_t(count);
    takePart(chains | std::views::transform(&Seen::cut));
    const float height = (step.bottom - step.top) / float(count);
    Shown right;
    const std::int32_t windingLeft = winding_;
    for (int i = 0; i < count; ++i) {
        winding_ = windingLeft;
        const Step small{step.top + float(i) * height, step.top + float(i + 1) * height,
                         step.height / float(count)};
        lookAtPart(small);
        right = cross(partSorted_, small, left, begin, end);
        if (i + 1 < count && !isOneColor_)
            for (const Seen& seen : part_)
                if (seen.isAtMiddle)
                    state_.cross(seen.layer, -seen.winding);
    }
    left = right;
}

/// From left to right through the chains at the middle of a step, all of which lie between `begin` and `end`,
/// as does what is drawn of programs. Returns the region on their right.
LineSweep::Shown LineSweep::cross(std::span<const Seen> chains, const Step& step, const Shown& left,
                                  float begin, float end) {
    if (isOneColor_) {
        addOutline(chains, step.height);
        return {};
    }
    if (isInPixels_) {
        crossInPixels(chains, step, begin, end);
        return {};
    }
    // Of two chains next to each other the second often leads back. Nothing is copied: what was just written
    // is slow to read at once.
    std::array<Shown, 3> shown{left};
    Shown *here = &shown[0], *before = &shown[1], *spare = &shown[2];
    std::uint64_t keyHere = state_.key(), keyBefore = keyHere;
    bool isHere = true;  // what was asked for last is what shows
    const Seen *asked = nullptr, *crossed = nullptr;
    const auto isNear = [&](const Seen& seen) {
        return asked && seen.x - asked->x < nearChains && std::abs(seen.from - asked->from) < nearChains &&
               std::abs(seen.to - asked->to) < nearChains;
    };
    std::array<PaintChange, 2> changes;
    PaintChange *next = &changes[0], *last = &changes[1];
    const auto ask = [&](const Seen& seen) {
        isHere = true;
        asked = &seen;
        if (state_.key() == keyHere)
            return;
        if (state_.key() != keyBefore) {
            lookHere(*spare);
            std::swap(before, spare);
            keyBefore = state_.key();
        }
        std::swap(here, before);
        std::swap(keyHere, keyBefore);
        if (here->showsAs(*before))
            return;
        next->seen = &seen;
        next->isUpright = seen.isBent();
        next->left = before->region.paint;
        next->right = here->region.paint;
        next->color = here->color - before->color;
        if (last->seen) {
            last->meet(*next);
            add(*last, step);
        }
        std::swap(next, last);
    };
    for (const Seen& seen : chains) {
        if (!seen.isAtMiddle)
            continue;
        if (!isHere && !isNear(seen))
            ask(*crossed);
        state_.cross(seen.layer, seen.winding);
        isHere = isHere && (state_.key() == keyHere || state_.isHidden(seen.layer, here->region));
        crossed = &seen;
    }
    if (!isHere)
        ask(*crossed);
    if (last->seen)
        add(*last, step);
    return *here;
}

/// The same where paints are composited in each pixel.
void LineSweep::crossInPixels(std::span<const Seen> chains, const Step& step, float begin, float end) {
    changes_.clear();
    const auto cross = [&](const Seen& seen, std::int32_t winding) {
        const std::uint64_t key = state_.key();
        state_.cross(seen.layer, winding);
        return state_.key() != key;
    };
    std::uint32_t hidden = state_.hiddenByFew();
    for (const Seen& seen : chains)
        if (seen.isAtMiddle && cross(seen, seen.winding)) {
            if (seen.layer < hidden && !state_.isOfClip(seen.layer))
                continue;
            hidden = state_.hiddenByFew();
            Change next{&seen, seen.isBent()};
            if (!changes_.empty())
                changes_.back().meet(next);
            changes_.push_back(next);
        }
    for (const Seen& seen : chains)
        if (seen.isAtMiddle)
            cross(seen, -seen.winding);
    Edge left{begin, begin};
    auto change = changes_.begin();
    for (const Seen& seen : chains) {
        if (change != changes_.end() && change->seen == &seen) {
            const Edge right = (change++)->edge();
            addInPixels(left, right, step);
            left = right;
        }
        if (seen.isAtMiddle)
            cross(seen, seen.winding);
    }
    addInPixels(left, {end, end}, step);
}

/// Which are inside all over a pixel of the row, and which in parts of it.
void LineSweep::findLayersOfPixels(float top, float bottom) {
    limits::check();
    const auto column = [&](float x) {
        return std::int32_t(std::clamp(std::floor(x), -1.0f, float(width_)));
    };
    pixels_.beginRow(int(top));
    for (std::size_t i = 0; i < cuts_.size();) {
        const std::uint32_t layer = cuts_[i].layer;
        touches_.clear();
        for (; i < cuts_.size() && cuts_[i].layer == layer; ++i) {
            Seen seen;
            look(i, {top, bottom, bottom - top}, seen);
            touches_.push_back(
                {column(seen.left - nearPixel), column(seen.right + nearPixel), seen.winding, seen.hasEnd});
        }
        const std::int32_t lastEnd = lastOfEnds(touches_);
        for (Touch& touch : touches_)
            if (touch.isEnd)
                touch.last = lastEnd;
        sortStably(touches_.begin(), touches_.end(),
                   [](const Touch& a, const Touch& b) { return a.first < b.first; });
        std::int32_t winding = 0;
        for (std::size_t k = 0; k < touches_.size();) {
            const std::int32_t first = touches_[k].first;
            std::int32_t end = first;
            for (; k < touches_.size() && touches_[k].first <= end; ++k) {
                end = std::max(end, touches_[k].last + 1);
                winding += touches_[k].winding;
            }
            pixels_.add(state_, layer, first, end, true);
            if (k < touches_.size() && state_.isInside(layer, winding))
                pixels_.add(state_, layer, end, touches_[k].first, false);
        }
    }
}

void LineSweep::lookHere(Shown& shown) {
    ++regionsAsked_;
    if (!remembers_) {
        shown.region = state_.regionOfPixels(shown.color);
        return;
    }
    shown.region = state_.region();
    shown.color = shown.isProgram() ? glm::vec4(0) : state_.colors()[std::exchange(shown.region.paint, 0)];
}

/// Of one layer, whose inside is a colour: what changes from column to column.
class LineSweep::OutlineSum {
public:
    OutlineSum(LineSweep& of, float height)
        : shares_(of.shares_),
          winding_(of.winding_),
          mask_(of.isEvenOdd_ ? 1 : -1),
          height_(height),
          isInside_((winding_ & mask_) != 0) {}

    /// Of all chains at the middle, from left to right.
    void cross(const Seen& seen) {
        winding_ += seen.winding;
        if (((winding_ & mask_) != 0) == isInside_)
            return;
        Change next{&seen, seen.isBent()};
        if (last_.seen) {
            last_.meet(next);
            addLast();
        }
        isInside_ = !isInside_;
        lastSeen_ = seen;
        last_ = {&lastSeen_, next.isUpright};
    }
    void finish() {
        if (last_.seen)
            addLast();
    }

private:
    void addLast() {
        const Edge edge = last_.edge();
        addAlong(shares_, edge.from, edge.to, isInside_ ? height_ : -height_);
    }

    std::vector<float>& shares_;
    std::int32_t& winding_;
    const std::int32_t mask_;
    const float height_;
    bool isInside_;
    Seen lastSeen_{};
    Change last_;
};

void LineSweep::addOutline(std::span<const Seen> chains, float height) {
    OutlineSum sum(*this, height);
    for (const Seen& seen : chains)
        if (seen.isAtMiddle)
            sum.cross(seen);
    sum.finish();
}

/// All chains, where they are in their order. False if they are not, or smaller steps are wanted; then
/// nothing is done.
bool LineSweep::addInOrder(const Step& step) {
    if (!isOneColor_)
        return false;
    limits::check();
    sharesBefore_ = shares_;
    winding_ = 0;
    hasSpecial_ = false;
    OutlineSum sum(*this, step.height);
    Seen seen;
    float left = -INFINITY;
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
        fetchAhead(cuts_, i, step.bottom, vertices_);
        look(i, step, seen);
        if ((seen.isAtMiddle && seen.x < left) || (hasSpecial_ && smallSteps_ > 0)) {
            shares_.swap(sharesBefore_);
            return false;
        }
        if (seen.isAtMiddle) {
            left = seen.x;
            sum.cross(seen);
        }
    }
    sum.finish();
    return true;
}

void LineSweep::add(const PaintChange& change, const Step& step) {
    const Edge edge = change.edge();
    if (((change.left | change.right) & programBit) != 0)
        chords_->push_back({{edge.from, drawn_}, {edge.to, drawn_ + step.height}, change.left, change.right});
    addAlong(sums_, edge.from, edge.to, step.height * change.color);
}

/// What lies between two edges, column by column.
void LineSweep::addInPixels(const Edge& left, const Edge& right, const Step& step) {
    if (state_.key() == 0)
        return;
    addAlong(shares_, left.from, left.to, step.height);
    addAlong(shares_, right.from, right.to, -step.height);
    const auto columnOf = [&](float x) { return std::size_t(std::clamp(x, 0.0f, float(width_))); };
    const std::size_t first = columnOf(std::min({left.from, left.to, right.from, right.to})),
                      last = columnOf(std::max({left.from, left.to, right.from, right.to}));
    const float from = 0.5f * (left.from + left.to), to = 0.5f * (right.from + right.to);
    PixelPlace place{0, {0, step.middle() - std::floor(step.top)}};
    float share = 0;
    for (std::size_t column = first; column <= last + 1; ++column) {
        share += std::exchange(shares_[column], 0.0f);
        if (share == 0 || column >= std::size_t(width_))
            continue;
        const auto begin = float(column);
        place.x = int(column);
        place.middle.x = 0.5f * (std::clamp(from - begin, 0.0f, 1.0f) + std::clamp(to - begin, 0.0f, 1.0f));
        ++pixelsAsked_;
        pixelSums_[column] += share * pixels_.color(state_, place);
    }
}

/// A change along an edge, by columns, with its whole height. The last column is beyond the picture.
template <class Amount>
void LineSweep::addAlong(std::vector<Amount>& sums, float from, float to, const Amount& amount) {
    const float end = float(sums.size()) - 1.5f;
    const float a = std::clamp(std::min(from, to), 0.0f, end), b = std::clamp(std::max(from, to), 0.0f, end);
    const auto first = std::size_t(a), last = std::size_t(b);
    if (first == last) {
        const float later = 0.5f * (a + b) - float(first);
        sums[first] += (1 - later) * amount;
        sums[first + 1] += later * amount;
        return;
    }
    const float perColumn = 1 / (b - a);
    for (std::size_t column = first; column <= last; ++column) {
        const float enter = std::max(a, float(column)), leave = std::min(b, float(column + 1));
        const float share = (leave - enter) * perColumn, later = 0.5f * (enter + leave) - float(column);
        sums[column] += share * (1 - later) * amount;
        sums[column + 1] += share * later * amount;
    }
}

/// The columns' colours as paints.
void LineSweep::finishRow(float top, float bottom) {
    const float perHeight = 1 / (bottom - top);
    glm::vec4 sum(0);
    RegionPaint left = 0;
    if (isOneColor_)
        for (std::size_t column = 0; column < sums_.size(); ++column)
            sums_[column] = std::exchange(shares_[column], 0.0f) * color_;
    for (int x = 0; x < width_; ++x) {
        const auto column = std::size_t(x);
        sum += sums_[column];
        if (sums_[column] == glm::vec4(0) && pixelSums_[column] == glm::vec4(0) &&
            (x == 0 || pixelSums_[column - 1] == glm::vec4(0)))
            continue;
        const RegionPaint right = state_.paintOf(withinAPixel(perHeight * (sum + pixelSums_[column])));
        chords_->push_back({{float(x), top}, {float(x), bottom}, left, right});
        left = right;
    }
    if (left != 0)
        chords_->push_back({{float(width_), top}, {float(width_), bottom}, left, 0});
    std::ranges::fill(sums_, glm::vec4(0));
    std::ranges::fill(pixelSums_, glm::vec4(0));
}

}  // namespace vtm::compiler

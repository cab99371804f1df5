#include "compiler/direct/line_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/small_sort.hpp"
#include "compiler/paint/region_paints.hpp"

namespace vtm::compiler {
namespace {

/// Chains in steps, a row in the mean: what a row may cost.
constexpr double cutsInRow = 200'000;
/// And in smaller steps, a band.
constexpr std::size_t smallCutsInBand = 16 * 100'000;
constexpr std::size_t mostSteps = 64, leastSteps = 2;
/// So many times more steps are taken in a row in which all chains begin or end.
constexpr double moreForEnds = 16;
/// Contents of parts of a row are equal if their chains are within this many pixels.
constexpr float sameColumn = 1.0f / 1024;
/// An edge that reaches over more columns in a step is nearly level: what it misplaces is seen.
constexpr float mostReach = 0.25f;
/// Chains near those take so many steps instead of one, at most.
constexpr int mostSmallSteps = 1024;

/// Where so many chains are cut, or more, of so many layers, those are looked for that are hidden in a step.
constexpr std::size_t manyCuts = 1u << 14, manyLayers = 64;
/// So many chains before one is looked at, its vertices are fetched.
constexpr std::size_t ahead = 16;
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

LineSweep::LineSweep(const ViewChains& chains, RegionState& state, int width)
    : chains_(chains),
      vertices_(chains.vertices()),
      state_(state),
      width_(width),
      sums_(std::size_t(width) + 2),
      squares_(std::size_t((width + 2) * squaresInAPixel + 2)) {}

void LineSweep::run(std::span<const std::uint32_t> numbers, float top, float bottom,
                    std::vector<asset::Chord>& chords) {
    if (meanCut_ == 0) {
        meanCut_ = meanCutOf(chains_);
        isOneLayer_ = std::ranges::all_of(chains_.all(), [&](const DownChain& chain) {
            return chain.layer == chains_.all().begin()->layer;
        });
    }
    chords_ = &chords;
    cuts_.clear();
    toCome_ = numbers;
    smallInBand_ = smallCutsInBand;
    while (top < bottom) {
        const float end = std::min(std::floor(top) + 1, bottom);
        row(top, end);
        top = end;
    }
}

void LineSweep::row(float top, float bottom) {
    std::erase_if(cuts_, [&](const Cut& cut) { return cut.bottom <= top; });
    take(top, bottom);
    hides_ = mayHide();
    isArranged_ = false;
    order_.clear();
    findPieces(top, bottom);
    const double ends = double(changes_.size()) / double(cuts_.size() + 1);
    const auto count = std::size_t(cutsInRow / (meanCut_ + 1) * (1 + moreForEnds * ends));
    const bool isByContent = findSteps(top, bottom, std::clamp(count, leastSteps, mostSteps));
    // A step may take several times its share of what the band may.
    const auto stepsLeft =
        std::size_t(asset::bandRows - std::fmod(top, float(asset::bandRows))) * steps_.size();
    const std::size_t share = 8 * smallInBand_ / std::max<std::size_t>(stepsLeft, 1);
    drawn_ = top;
    for (const Step& step : steps_) {
        const std::size_t may = isByContent ? 0 : std::min(share, smallInBand_);
        smallSteps_ = may;
        draw(step);
        smallInBand_ -= may - smallSteps_;
    }
    finishRow(top, bottom);
}

// ---- Steps ----------------------------------------------------------------------------------------

/// Whether they are placed by content.
bool LineSweep::findSteps(float top, float bottom, std::size_t count) {
    steps_.clear();
    if (placeByContent(top, bottom, count))
        return true;
    const float height = (bottom - top) / float(count);
    for (std::size_t i = 0; i < count; ++i)
        steps_.push_back({top + float(i) * height, top + float(i + 1) * height, height});
    return false;
}

/// Cuts the row where chains begin and end.
void LineSweep::findPieces(float top, float bottom) {
    changes_.clear();
    pieces_.clear();
    std::uint64_t content = 0;
    for (const Cut& cut : cuts_) {
        if (cut.top <= top && cut.bottom >= bottom)
            continue;
        const auto column = std::int64_t(vertices_[cut.at].x / sameColumn);
        const std::uint64_t own = hashValue(hashValue(cut.layer) + std::uint64_t(std::int64_t(cut.winding)) +
                                            hashValue(std::uint64_t(column)));
        if (cut.top <= top)
            content += own;
        else
            changes_.push_back({cut.top, own});
        if (cut.bottom < bottom)
            changes_.push_back({cut.bottom, 0 - own});
    }
    std::ranges::sort(changes_, {}, &Change::y);
    for (std::size_t i = 0; i <= changes_.size(); ++i) {
        const float next = i < changes_.size() ? changes_[i].y : bottom;
        if (next > top) {
            pieces_.push_back({top, next, content});
            top = next;
        }
        if (i < changes_.size())
            content += changes_[i].content;
    }
}

/// Pieces with the same content share steps. False if contents are too many, or too few are the same.
bool LineSweep::placeByContent(float top, float bottom, std::size_t most) {
    std::ranges::sort(pieces_, [](const Piece& a, const Piece& b) {
        return a.content != b.content ? a.content < b.content : a.top < b.top;
    });
    std::size_t contents = 1;
    for (std::size_t i = 1; i < pieces_.size(); ++i)
        contents += pieces_[i].content != pieces_[i - 1].content;
    if (contents > most || 2 * contents > pieces_.size())
        return false;
    const float part = (bottom - top) / float(most / contents);
    for (std::size_t i = 0, end = 0; i < pieces_.size(); i = end) {
        const float to = top + part * (std::floor((pieces_[i].top - top) / part) + 1);
        float height = 0, moment = 0;
        for (; end < pieces_.size() && pieces_[end].content == pieces_[i].content && pieces_[end].top < to;
             ++end) {
            const float own = pieces_[end].bottom - pieces_[end].top;
            height += own;
            moment += own * 0.5f * (pieces_[end].top + pieces_[end].bottom);
        }
        // The piece nearest to the middle stands for all.
        const float middle = moment / height;
        const auto distance = [&](const Piece& p) { return std::abs(0.5f * (p.top + p.bottom) - middle); };
        const Piece* nearest = &pieces_[i];
        for (std::size_t k = i; k < end; ++k)
            if (distance(pieces_[k]) < distance(*nearest))
                nearest = &pieces_[k];
        steps_.push_back({nearest->top, nearest->bottom, height});
    }
    std::ranges::sort(steps_, {}, &Step::top);
    return true;
}

// ---- Chains ---------------------------------------------------------------------------------------

/// Those that begin above the bottom and do not end above the top.
void LineSweep::take(float top, float bottom) {
    std::size_t begun = 0;
    const auto before = std::ptrdiff_t(cuts_.size());
    for (; begun < toCome_.size() && chains_[toCome_[begun]].top < bottom; ++begun) {
        const DownChain& chain = chains_[toCome_[begun]];
        if (chain.bottom <= top)
            continue;
        cuts_.push_back({chain.first, chain.end - 1, chain.top, chain.bottom, chain.layer, chain.winding,
                         vertices_[chain.first].x});
    }
    toCome_ = toCome_.subspan(begun);
    const auto arrangeNew = [&](auto isBefore) {
        std::stable_sort(cuts_.begin() + before, cuts_.end(), isBefore);
        std::inplace_merge(cuts_.begin(), cuts_.begin() + before, cuts_.end(), isBefore);
    };
    if (isOneLayer_)
        arrangeNew([](const Cut& a, const Cut& b) { return a.x < b.x; });
    else
        arrangeNew([](const Cut& a, const Cut& b) { return a.layer > b.layer; });
}

void LineSweep::look(std::size_t number, const Step& step, Seen& seen) {
    Cut& cut = cuts_[number];
    seen.cut = std::uint32_t(number);
    seen.layer = cut.layer;
    seen.winding = cut.winding;
    seen.isAtMiddle = cut.isAt(step.middle());
    seen.hasEnd = cut.top > step.top || cut.bottom < step.bottom;
    const auto findEdge = [&] {
        while (vertices_[cut.at + 1].y <= step.top && cut.at + 1 < cut.last)
            ++cut.at;
        const glm::vec2 a = vertices_[cut.at], b = vertices_[cut.at + 1];
        if (a.y > step.top || b.y < step.bottom || a.y == b.y)
            return false;
        cut.a = a;
        cut.slope = (b.x - a.x) / (b.y - a.y);
        cut.edgeBottom = b.y;
        return true;
    };
    if ((cut.a.y <= step.top && cut.edgeBottom >= step.bottom) || findEdge()) {
        seen.from = cut.a.x + (step.top - cut.a.y) * cut.slope;
        seen.to = cut.a.x + (step.bottom - cut.a.y) * cut.slope;
        seen.x = 0.5f * (seen.from + seen.to);
        seen.left = std::min(seen.from, seen.to);
        seen.right = std::max(seen.from, seen.to);
    } else {
        lookAround(cut, step, seen);
    }
    seen.isSpecial =
        cut.top < step.bottom && cut.bottom > step.top && (seen.hasEnd || seen.right - seen.left > mostReach);
    cut.x = seen.x;
}

/// Where it has a vertex.
void LineSweep::lookAround(const Cut& cut, const Step& step, Seen& seen) const {
    const auto xAt = [&](const glm::vec2* edge, float y) {
        return edge[0].x + (y - edge[0].y) * ((edge[1].x - edge[0].x) / (edge[1].y - edge[0].y));
    };
    const glm::vec2* edge = vertices_ + cut.at;
    const glm::vec2 *const first = edge, *const last = vertices_ + cut.last;
    // Above its upper end and below its lower one it is taken to be there.
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

/// Chains' vertices lie far from each other.
void LineSweep::fetchAhead(std::size_t number, const Step& step) const {
    if (number + ahead < cuts_.size() && cuts_[number + ahead].edgeBottom < step.bottom)
        __builtin_prefetch(vertices_ + cuts_[number + ahead].at + 1);
}

void LineSweep::lookAtAll(const Step& step) {
    seen_.resize(cuts_.size());
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
        fetchAhead(i, step);
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
    CoveredRow(squares_).clear();
    for (std::size_t i = 0; i < cuts_.size();) {
        const std::size_t before = seen_.size();
        for (const std::uint32_t layer = cuts_[i].layer; i < cuts_.size() && cuts_[i].layer == layer; ++i) {
            fetchAhead(i, step);
            look(i, step, seen_.emplace_back());
        }
        if (!isShown(std::span(seen_).subspan(before)))
            seen_.erase(seen_.begin() + std::ptrdiff_t(before), seen_.end());
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
        return std::clamp(std::int32_t((x + ViewChains::beside) * squaresInAPixel), 0,
                          std::int32_t(squares_.size()) - 2);
    };
    touches_.clear();
    for (const Seen& seen : ofLayer) {
        const std::int32_t winding = seen.isAtMiddle ? seen.winding : 0;
        if (seen.isSpecial)
            touches_.push_back({square(seen.left), square(seen.right), winding});
        else if (seen.isAtMiddle)
            touches_.push_back({square(seen.x), square(seen.x), winding});
    }
    sortStably(touches_.begin(), touches_.end(),
               [](const Touch& a, const Touch& b) { return a.first < b.first; });
    std::size_t steps = squares_.size();
    return CoveredRow(squares_).add(touches_, cover, state_.isEvenOdd(layer), steps);
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

void LineSweep::draw(const Step& step) {
    limits::check();
    if (hides_)
        lookForShown(step);
    else
        lookAtAll(step);
    sortPlaces(order_, spare_);
    if (isOneLayer_ && !isArranged_)
        arrangeCuts();
    if (isInOrder(order_))
        sorted_.swap(seen_);
    else
        arrange(seen_, order_, sorted_);
    if (smallSteps_ > 0 && std::ranges::any_of(sorted_, &Seen::isSpecial))
        drawByParts(step);
    else
        cross(sorted_, step, {});
    drawn_ += step.height;
}

/// Chains that reach into the same columns, together.
void LineSweep::drawByParts(const Step& step) {
    leftmost_.resize(sorted_.size());
    float leftmost = INFINITY;
    for (std::size_t i = sorted_.size(); i-- > 0;)
        leftmost_[i] = leftmost = std::min(leftmost, sorted_[i].left);
    Region left;
    float right = -INFINITY;
    bool hasSpecial = false;
    for (std::size_t first = 0, i = 0; i < sorted_.size(); ++i) {
        right = std::max(right, sorted_[i].right);
        hasSpecial = hasSpecial || sorted_[i].isSpecial;
        if (i + 1 < sorted_.size() && right >= leftmost_[i + 1])
            continue;
        const std::span part = std::span(sorted_).subspan(first, i + 1 - first);
        if (hasSpecial && smallSteps_ > 0)
            drawInSteps(part, step, left);
        else
            left = cross(part, step, left);
        first = i + 1;
        right = -INFINITY;
        hasSpecial = false;
    }
}

/// Some of the chains in smaller steps, as many as their reach asks for and the row may take.
void LineSweep::drawInSteps(std::span<const Seen> chains, const Step& step, Region& left) {
    float reach = 0;
    bool hasEnds = false;
    for (const Seen& seen : chains) {
        reach = std::max(reach, seen.right - seen.left);
        hasEnds = hasEnds || seen.hasEnd;
    }
    auto count = std::clamp(int(reach / mostReach) + 1, hasEnds ? 4 : 1, mostSmallSteps);
    count = int(std::min(std::size_t(count), smallSteps_ / chains.size()));
    if (count <= 1) {
        left = cross(chains, step, left);
        return;
    }
    smallSteps_ -= chains.size() * std::size_t(count);
    part_.assign(chains.begin(), chains.end());
    partOrder_.clear();
    for (const Seen& seen : part_)
        partOrder_.push_back({seen.x, std::uint32_t(partOrder_.size())});
    const float height = (step.bottom - step.top) / float(count);
    Region right;
    for (int i = 0; i < count; ++i) {
        const Step small{step.top + float(i) * height, step.top + float(i + 1) * height,
                         step.height / float(count)};
        for (Placed& p : partOrder_) {
            look(part_[p.number].cut, small, part_[p.number]);
            p.x = part_[p.number].x;
        }
        sortPlaces(partOrder_, spare_);
        arrange(part_, partOrder_, partSorted_);
        right = cross(partSorted_, small, left);
        if (i + 1 < count)
            for (const Seen& seen : part_)
                if (seen.isAtMiddle)
                    state_.cross(seen.layer, -seen.winding);
    }
    left = right;
}

/// From left to right through the chains at the middle of a step. Returns the region on their right.
Region LineSweep::cross(std::span<const Seen> chains, const Step& step, Region left) {
    // Of two chains next to each other the second often leads back.
    Region before;
    std::uint64_t keyBefore = 0, key = state_.key();
    bool isKnown = false;
    for (const Seen& seen : chains) {
        if (!seen.isAtMiddle)
            continue;
        state_.cross(seen.layer, seen.winding);
        const std::uint64_t keyLeft = std::exchange(key, state_.key());
        if (key == keyLeft)
            continue;
        if (state_.isHidden(seen.layer, left)) {
            isKnown = false;
            continue;
        }
        const Region right = isKnown && key == keyBefore ? before : state_.region();
        if (right.paint != left.paint)
            change(seen, step, left.paint, right.paint);
        before = std::exchange(left, right);
        keyBefore = keyLeft;
        isKnown = true;
    }
    return left;
}

void LineSweep::change(const Seen& seen, const Step& step, RegionPaint left, RegionPaint right) {
    const auto isProgram = [](RegionPaint paint) { return (paint & programBit) != 0; };
    if (isProgram(left) || isProgram(right))
        chords_->push_back({{seen.from, drawn_},
                            {seen.to, drawn_ + step.height},
                            isProgram(left) ? left : 0,
                            isProgram(right) ? right : 0});
    const auto colorOf = [&](RegionPaint paint) {
        return isProgram(paint) ? glm::vec4(0) : state_.colors()[paint];
    };
    add(seen.from, seen.to, step.height * (colorOf(right) - colorOf(left)));
}

/// A change along an edge, by columns, with its whole height.
void LineSweep::add(float from, float to, const glm::vec4& amount) {
    const float end = float(width_) + 0.5f;
    const float a = std::clamp(std::min(from, to), 0.0f, end), b = std::clamp(std::max(from, to), 0.0f, end);
    const auto first = std::size_t(a), last = std::size_t(b);
    if (first == last) {
        const float later = 0.5f * (a + b) - float(first);
        sums_[first] += (1 - later) * amount;
        sums_[first + 1] += later * amount;
        return;
    }
    const float perColumn = 1 / (b - a);
    for (std::size_t column = first; column <= last; ++column) {
        const float enter = std::max(a, float(column)), leave = std::min(b, float(column + 1));
        const float share = (leave - enter) * perColumn, later = 0.5f * (enter + leave) - float(column);
        sums_[column] += share * (1 - later) * amount;
        sums_[column + 1] += share * later * amount;
    }
}

/// The columns' colours as paints.
void LineSweep::finishRow(float top, float bottom) {
    const float perHeight = 1 / (bottom - top);
    glm::vec4 sum(0);
    RegionPaint left = 0;
    for (int x = 0; x < width_; ++x) {
        sum += sums_[std::size_t(x)];
        if (sums_[std::size_t(x)] == glm::vec4(0))
            continue;
        const RegionPaint right = state_.paintOf(withinAPixel(perHeight * sum));
        chords_->push_back({{float(x), top}, {float(x), bottom}, left, right});
        left = right;
    }
    if (left != 0)
        chords_->push_back({{float(width_), top}, {float(width_), bottom}, left, 0});
    std::ranges::fill(sums_, glm::vec4(0));
}

}  // namespace vtm::compiler

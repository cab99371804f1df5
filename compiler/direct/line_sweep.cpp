#include "compiler/direct/line_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vtm/limits/limits.hpp>
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

}  // namespace

LineSweep::LineSweep(const ViewChains& chains, RegionState& state, int width)
    : chains_(chains),
      vertices_(chains.vertices()),
      state_(state),
      width_(width),
      sums_(std::size_t(width) + 2) {}

void LineSweep::run(std::span<const std::uint32_t> numbers, float top, float bottom,
                    std::vector<asset::Chord>& chords) {
    if (meanCut_ == 0)
        meanCut_ = meanCutOf(chains_);
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
        cuts_.push_back({chain.first, chain.end - 1, chain.top, chain.bottom, vertices_[chain.first].x, 0, 0,
                         0, 0, chain.layer, chain.winding});
    }
    toCome_ = toCome_.subspan(begun);
    const auto isLeft = [](const Cut& a, const Cut& b) { return a.x < b.x; };
    std::stable_sort(cuts_.begin() + before, cuts_.end(), isLeft);
    std::inplace_merge(cuts_.begin(), cuts_.begin() + before, cuts_.end(), isLeft);
}

bool LineSweep::Cut::isSpecial(const Step& step) const {
    return top < step.bottom && bottom > step.top &&
           (right - left > mostReach || top > step.top || bottom < step.bottom);
}

/// Where the chain goes in the step.
void LineSweep::look(Cut& cut, const Step& step) const {
    while (vertices_[cut.at + 1].y <= step.top && cut.at + 1 < cut.last)
        ++cut.at;
    const glm::vec2 a = vertices_[cut.at], b = vertices_[cut.at + 1];
    if (a.y > step.top || b.y < step.bottom || a.y == b.y)
        return lookAround(cut, step);
    const float slope = (b.x - a.x) / (b.y - a.y);
    cut.from = a.x + (step.top - a.y) * slope;
    cut.to = a.x + (step.bottom - a.y) * slope;
    cut.x = 0.5f * (cut.from + cut.to);
    cut.left = std::min(cut.from, cut.to);
    cut.right = std::max(cut.from, cut.to);
}

/// Where it has a vertex.
void LineSweep::lookAround(Cut& cut, const Step& step) const {
    const auto xAt = [&](const glm::vec2* edge, float y) {
        return edge[0].x + (y - edge[0].y) * ((edge[1].x - edge[0].x) / (edge[1].y - edge[0].y));
    };
    const glm::vec2* edge = vertices_ + cut.at;
    const glm::vec2 *const first = edge, *const last = vertices_ + cut.last;
    // Above its upper end and below its lower one it is taken to be there.
    const float middle = step.middle();
    cut.from = edge->y < step.top && edge[1].y > step.top ? xAt(edge, step.top) : edge->x;
    if (edge[1].y <= step.top)
        cut.from = edge[1].x;
    cut.x = cut.to = cut.left = cut.right = cut.from;
    for (; edge < last && edge->y < step.bottom; ++edge) {
        if (edge->y <= middle && edge[1].y > middle)
            cut.x = xAt(edge, middle);
        else if (edge[1].y <= middle)
            cut.x = edge[1].x;
        cut.to = edge[1].y > step.bottom ? xAt(edge, step.bottom) : edge[1].x;
        if (edge->y >= step.top || edge == first) {
            cut.left = std::min(cut.left, cut.to);
            cut.right = std::max(cut.right, cut.to);
        }
    }
}

/// They are nearly in order, as a rule.
void LineSweep::sort(std::vector<Cut>& cuts) {
    constexpr std::size_t manyMoves = 16;
    std::size_t moves = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (!(cuts[i].x < cuts[i - 1].x))
            continue;
        const Cut cut = cuts[i];
        std::size_t to = i;
        do {
            cuts[to] = cuts[to - 1];
            --to;
        } while (to > 0 && cut.x < cuts[to - 1].x);
        cuts[to] = cut;
        moves += i - to;
        if (moves > manyMoves * cuts.size()) {
            std::ranges::stable_sort(cuts, {}, &Cut::x);
            return;
        }
    }
}

// ---- Drawing --------------------------------------------------------------------------------------

void LineSweep::draw(const Step& step) {
    limits::check();
    bool hasSpecial = false;
    for (Cut& cut : cuts_) {
        look(cut, step);
        hasSpecial = hasSpecial || cut.isSpecial(step);
    }
    sort(cuts_);
    if (hasSpecial && smallSteps_ > 0)
        drawByParts(step);
    else
        cross(cuts_, step, {});
    drawn_ += step.height;
}

/// Chains that reach into the same columns, together.
void LineSweep::drawByParts(const Step& step) {
    leftmost_.resize(cuts_.size());
    float leftmost = INFINITY;
    for (std::size_t i = cuts_.size(); i-- > 0;)
        leftmost_[i] = leftmost = std::min(leftmost, cuts_[i].left);
    Region left;
    float right = -INFINITY;
    bool hasSpecial = false;
    for (std::size_t first = 0, i = 0; i < cuts_.size(); ++i) {
        right = std::max(right, cuts_[i].right);
        hasSpecial = hasSpecial || cuts_[i].isSpecial(step);
        if (i + 1 < cuts_.size() && right >= leftmost_[i + 1])
            continue;
        const std::span part = std::span(cuts_).subspan(first, i + 1 - first);
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
void LineSweep::drawInSteps(std::span<const Cut> cuts, const Step& step, Region& left) {
    float reach = 0;
    bool hasEnds = false;
    for (const Cut& cut : cuts) {
        reach = std::max(reach, cut.right - cut.left);
        hasEnds = hasEnds || cut.top > step.top || cut.bottom < step.bottom;
    }
    auto count = std::clamp(int(reach / mostReach) + 1, hasEnds ? 4 : 1, mostSmallSteps);
    count = int(std::min(std::size_t(count), smallSteps_ / cuts.size()));
    if (count <= 1) {
        left = cross(cuts, step, left);
        return;
    }
    smallSteps_ -= cuts.size() * std::size_t(count);
    part_.assign(cuts.begin(), cuts.end());
    const float height = (step.bottom - step.top) / float(count);
    Region right;
    for (int i = 0; i < count; ++i) {
        const Step small{step.top + float(i) * height, step.top + float(i + 1) * height,
                         step.height / float(count)};
        for (Cut& cut : part_)
            look(cut, small);
        sort(part_);
        right = cross(part_, small, left);
        if (i + 1 < count)
            for (const Cut& cut : part_)
                if (cut.isAt(small.middle()))
                    state_.cross(cut.layer, -cut.winding);
    }
    left = right;
}

/// From left to right through the chains at the middle of a step. Returns the region on their right.
Region LineSweep::cross(std::span<const Cut> cuts, const Step& step, Region left) {
    const float middle = step.middle();
    // Of two chains next to each other the second often leads back.
    Region before;
    std::uint64_t keyBefore = 0, key = state_.key();
    bool isKnown = false;
    for (const Cut& cut : cuts) {
        if (!cut.isAt(middle))
            continue;
        state_.cross(cut.layer, cut.winding);
        const std::uint64_t keyLeft = std::exchange(key, state_.key());
        if (key == keyLeft)
            continue;
        if (state_.isHidden(cut.layer, left)) {
            isKnown = false;
            continue;
        }
        const Region right = isKnown && key == keyBefore ? before : state_.region();
        if (right.paint != left.paint)
            change(cut, step, left.paint, right.paint);
        before = std::exchange(left, right);
        keyBefore = keyLeft;
        isKnown = true;
    }
    return left;
}

void LineSweep::change(const Cut& cut, const Step& step, RegionPaint left, RegionPaint right) {
    const auto isProgram = [](RegionPaint paint) { return (paint & programBit) != 0; };
    if (isProgram(left) || isProgram(right))
        chords_->push_back({{cut.from, drawn_},
                            {cut.to, drawn_ + step.height},
                            isProgram(left) ? left : 0,
                            isProgram(right) ? right : 0});
    const auto colorOf = [&](RegionPaint paint) {
        return isProgram(paint) ? glm::vec4(0) : state_.colors()[paint];
    };
    add(cut.from, cut.to, step.height * (colorOf(right) - colorOf(left)));
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

#include "compiler/direct/sampled_rows.hpp"

#include <algorithm>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "compiler/containers/small_sort.hpp"

namespace vtm::compiler {
namespace {

/// A pixel is so many squares wide and high that places of so many squares are asked in a picture like the
/// row before. A chain that is looked at takes a part of the time, and so does a square all of which a layer
/// covers.
constexpr float squaresInPicture = 1.2e7f, mostAlong = 8, look = 1.0f / 8, coveredSquare = 1.0f / 16;
/// More squares in a row take much memory, half a kilobyte each.
constexpr float squaresInRow = 1 << 14;
/// Where a layer has more chains for each pixel, they are met along rows of places instead, which takes this
/// long.
constexpr std::size_t denseInPixel = 32;
constexpr float denseLook = 1.0f / 6;
/// There, an edge that crosses more squares in a row is nearly level.
constexpr float levelSlope = 16;
/// Each of them takes so much of the time that places asked of a square do.
constexpr float crossedSquare = 1.0f / 32;
/// Winding numbers by one chain take so much of the time that a square does.
constexpr float askedOfChain = 1.0f / 4;
/// So many touches are sorted by digits.
constexpr std::size_t manyTouches = 64;
/// Of a row: the line of a chain that is less high is not known well.
constexpr float leastHeight = 1.0f / 1024;
/// So many pieces are kept before those on the left are forgotten, and so many for each chain of the square.
constexpr std::size_t keptPieces = 64, keptForChain = 8;

}  // namespace

SampledRows::SampledRows(const LoweredScene& picture, const ViewChains& chains, RegionState& state, int width)
    : height_(chains.height()),
      vertices_(chains.vertices()),
      state_(state),
      width_(width),
      solids_(picture),
      lights_(solids_.groups),
      taker_(chains),
      sums_(std::size_t(width)) {}

void SampledRows::run(std::span<const std::uint32_t> numbers, float top, float bottom,
                      std::vector<asset::Chord>& chords) {
    cuts_.clear();
    taker_.begin(numbers);
    int along = 1;
    std::size_t chainsBefore = 0;
    while (top < bottom) {
        const float end = std::min(std::floor(top) + 1, bottom);
        take(top, end);
        const bool isLikeBefore = cuts_.size() <= 2 * chainsBefore;
        chainsBefore = cuts_.size();
        along = isLikeBefore ? drawPixels(top, end, along) : drawFirst(top, end);
        finishRow(top, end, chords);
        top = end;
    }
}

/// Of which the row before tells little: drawn again as long as squares may be half as wide. Returns what
/// drawPixels() does.
int SampledRows::drawFirst(float top, float bottom) {
    const std::vector<CutChain> before = cuts_;
    for (int along = 1;;) {
        const int next = drawPixels(top, bottom, along);
        if (next < 2 * along)
            return next;
        std::ranges::fill(sums_, glm::vec4(0));
        cuts_ = before;
        along = next;
    }
}

/// A row of pixels, or a part of its height, each so many squares wide. Returns how many the next row's
/// should be.
int SampledRows::drawPixels(float top, float bottom, int along) {
    const auto by = float(along), down = std::max(1.0f, std::ceil(by * (bottom - top)));
    const float height = (bottom - top) / down;
    asked_ = covered_ = 1;
    for (float k = 0; k < down; ++k) {
        limits::check();
        row_ = {top + k * height, top + (k + 1) * height, by};
        drawRow();
    }
    // With more squares along a pixel, chains touch as many times more, and there are the square of it.
    const float most = squaresInPicture / float(height_) * down / by;
    const float next = std::min(most * by / asked_, std::sqrt(most / covered_) * by);
    return int(std::clamp(next, 1.0f, std::clamp(squaresInRow / float(width_), 1.0f, mostAlong)));
}

std::size_t SampledRows::endOfLayer(std::size_t first) const {
    std::size_t end = first;
    while (end < cuts_.size() && cuts_[end].layer == cuts_[first].layer)
        ++end;
    return end;
}

bool SampledRows::isDense(std::size_t chains) const { return chains > denseInPixel * std::size_t(width_); }

// ---- Chains ---------------------------------------------------------------------------------------

void SampledRows::take(float top, float bottom) {
    taker_.take(
        top, bottom, cuts_, [&](const DownChain& chain) { return solids_.layers[chain.layer].color.w > 0; },
        [](const CutChain& a, const CutChain& b) { return a.layer > b.layer; });
}

void SampledRows::drawRow() {
    const auto squares = std::size_t(width_) * std::size_t(row_.along);
    lights_.begin(std::int32_t(squares));
    for (std::size_t i = 0, end = 0; i < cuts_.size() && !lights_.areClosed(); i = end) {
        const std::uint32_t layer = cuts_[i].layer;
        end = endOfLayer(i);
        if (isDense(end - i)) {
            drawDense(std::span(cuts_).subspan(i, end - i), solids_.layers[layer]);
            continue;
        }
        touches_.clear();
        asked_ += look * float(end - i);
        for (; i < end; ++i) {
            fetchAhead(cuts_, i, row_.bottom, vertices_);
            lookAt(std::uint32_t(i));
        }
        if (!touches_.empty())
            drawTouched(solids_.layers[layer]);
    }
    const std::span<const glm::vec4> colors = lights_.finish();
    for (std::size_t i = 0; i < squares; ++i)
        sums_[i / std::size_t(row_.along)] += (row_.bottom - row_.top) / row_.along * colors[i];
}

/// Many chains meet each square: they are met along rows of places.
void SampledRows::drawDense(std::span<CutChain> cuts, const Layer& layer) {
    if (!steps_ || steps_->squares() != lights_.squares())
        steps_.emplace(lights_.squares());
    asked_ += denseLook * float(cuts.size()) + float(lights_.squares());
    for (CutChain& cut : cuts) {
        fetchAhead(cuts_, std::size_t(&cut - cuts_.data()), row_.bottom, vertices_);
        if (cut.edgeBottom <= row_.top)
            findEdge(cut, row_.top, vertices_);
        addSteps(cut);
        while (cut.edgeBottom < row_.bottom && cut.at + 1 < cut.last) {
            findEdge(cut, cut.edgeBottom, vertices_);
            addSteps(cut);
        }
    }
    lights_.enter(layer.group);
    steps_->takeAll([&](std::int32_t square, const PlaceWindings& windings) {
        if (lights_.nextOpen(square) == square)
            lights_.cover(square, layer, windings);
    });
}

/// The edge of the chain.
void SampledRows::addSteps(const CutChain& cut) {
    const auto rowAt = [&](float y) {  // the first whose middle is not above it
        return int(std::ceil(std::clamp(row_.heightOf(y), 0.0f, 1.0f) * placesAlong - 0.5f));
    };
    const int first = rowAt(cut.a.y), end = rowAt(cut.edgeBottom);
    if (first >= end)
        return;
    const glm::vec2 a = row_.inSquares(cut.a);
    const float slope = row_.inSquares(cut.slope);
    if (std::abs(slope) > levelSlope) {
        const glm::vec2 b = row_.inSquares(vertices_[cut.at + 1]);
        covered_ += crossedSquare * std::min(std::abs(b.x - a.x), float(lights_.squares()));
        return steps_->addLevel(first, end, a, b, cut.winding);
    }
    const float y = (float(first) + 0.5f) / placesAlong;
    steps_->add(first, end, a.x + (y - a.y) * slope, slope / placesAlong, cut.winding);
}

// ---- Squares --------------------------------------------------------------------------------------

/// Appends what the chain touches in the row, if it is in it.
void SampledRows::lookAt(std::uint32_t number) {
    const auto [top, bottom, along] = row_;
    CutChain& cut = cuts_[number];
    if (cut.edgeBottom <= top)
        findEdge(cut, top, vertices_);
    if (cut.edgeBottom <= top || cut.a.y >= bottom)
        return;
    const float begin = std::max(cut.a.y, top), from = cut.xAt(begin);
    const bool isStraight = cut.edgeBottom >= bottom;
    float end = bottom, to = isStraight ? cut.xAt(bottom) : from;
    float left = std::min(from, to), right = std::max(from, to);
    for (std::uint32_t at = cut.at; !isStraight && at < cut.last && vertices_[at].y < bottom; ++at) {
        const glm::vec2 a = vertices_[at], b = vertices_[at + 1];
        end = std::min(b.y, bottom);
        to = b.y <= bottom ? b.x : a.x + (bottom - a.y) * slopeOf(a, b);
        left = std::min(left, to);
        right = std::max(right, to);
    }
    const auto square = [&](float x) {  // rounded down
        return std::int32_t(std::clamp(x * along + 1, 0.0f, float(lights_.squares() + 1))) - 1;
    };
    touches_.push_back({square(left), square(right), number, cut.winding, begin, end,
                        RowLine{from * along, to * along}, begin <= top && end >= bottom, isStraight});
}

void SampledRows::sortTouches() {
    if (touches_.size() < manyTouches)
        return sortStably(touches_.begin(), touches_.end(),
                          [](const Touch& a, const Touch& b) { return a.first < b.first; });
    order_.clear();
    for (const Touch& touch : touches_)
        order_.push_back({float(touch.first), std::uint32_t(order_.size())});
    sortPlaces(order_, spare_);
    arranged_.clear();
    for (const Placed& p : order_)
        arranged_.push_back(touches_[p.number]);
    touches_.swap(arranged_);
}

/// The layer that the touches are of. Between its chains that begin or end in the row there may be level
/// sides, of which no chain tells: there, all squares are looked at. On the right of them winding numbers are
/// the same at all heights, and those that go on below tell by how much they have changed: a chain that ends
/// may go up again and down once more.
void SampledRows::drawTouched(const Layer& layer) {
    std::int32_t first = lights_.squares(), last = -1, lastEnd = -1;
    for (const Touch& touch : touches_) {
        first = std::min(first, touch.first);
        last = std::max(last, touch.last);
        if (!touch.spans)
            lastEnd = std::max(lastEnd, touch.last);
    }
    if (lights_.nextOpen(std::max(first, 0)) > last)
        return;
    lights_.enter(layer.group);
    sortTouches();
    std::int32_t winding = 0, covered = 0;
    for (std::size_t i = 0, end = 0; i < touches_.size(); i = end) {
        const std::int32_t begin = touches_[i].first;
        if (layer.isInside(winding))
            drawBetween(covered, begin, layer);
        covered = begin;
        std::int32_t after = winding;
        for (; end < touches_.size() && touches_[end].first <= covered; ++end) {
            const Touch& touch = touches_[end];
            covered = std::max(covered, (touch.spans ? touch.last : lastEnd) + 1);
            after += touch.bottom >= row_.bottom ? touch.winding : 0;
        }
        drawRun({std::span(touches_).subspan(i, end - i), std::max(begin, 0),
                 std::min(covered, lights_.squares()), winding, after},
                layer);
        winding = after;
        covered = std::max(covered, 0);
    }
}

/// Squares [first, end), all inside.
void SampledRows::drawBetween(std::int32_t first, std::int32_t end, const Layer& layer) {
    for (std::int32_t i = lights_.nextOpen(first); i < end; i = lights_.nextOpen(i + 1))
        cover(i, layer);
}

void SampledRows::cover(std::int32_t square, const Layer& layer) {
    covered_ += coveredSquare;
    lights_.cover(square, layer);
}

void SampledRows::drawRun(const Run& run, const Layer& layer) {
    pieces_.clear();
    active_.clear();
    bool hasEnds = false;  // on the left: onLeft_ is by height
    std::int32_t winding = run.windingLeft;
    std::size_t next = 0;
    for (std::int32_t square = lights_.nextOpen(run.first); square < run.end;
         square = lights_.nextOpen(square + 1)) {
        for (; next < run.touches.size() && run.touches[next].first <= square; ++next)
            active_.push_back(&run.touches[next]);
        leaveBehind(square, winding, hasEnds);
        const std::size_t count = active_.size();
        if (!hasEnds && count == 0) {
            if (layer.isInside(winding))
                cover(square, layer);
            continue;
        }
        if (!hasEnds && count == 1 && drawOne(*active_[0], square, winding, layer))
            continue;
        if (!hasEnds && count == 2 &&
            (isDarkBetween(*active_[0], *active_[1], square, winding, layer) ||
             isDarkBetween(*active_[1], *active_[0], square, winding, layer)))
            continue;
        // Where a chain begins or ends, the layer may still be on one side of it only.
        const bool isLeftOfIt = count == 1 && next == run.touches.size() && !layer.isInside(run.windingRight),
                   isRightOfIt = count == 1 && next == 1 && !layer.isInside(run.windingLeft);
        if ((isLeftOfIt && isDarkBeside(*active_[0], square, true)) ||
            (isRightOfIt && isDarkBeside(*active_[0], square, false)))
            continue;
        if (hasEnds)
            for (std::size_t i = 0; i < onLeft_.size(); ++i)
                windings_[i] = std::int16_t(onLeft_[i] + winding);
        else
            windings_.fill(std::int16_t(winding));
        asked_ += 1 + askedOfChain * float(count);
        for (Touch* touch : active_)
            addTouch(*touch, square);
        if (lights_.cover(square, layer, windings_) && (isLeftOfIt || isRightOfIt))
            keepDark(square, *active_[0], isLeftOfIt);
    }
}

/// What ends on the left of the square is added to the winding numbers there.
void SampledRows::leaveBehind(std::int32_t square, std::int32_t& winding, bool& hasEnds) {
    for (std::size_t i = 0; i < active_.size();) {
        const Touch& touch = *active_[i];
        if (touch.last >= square) {
            ++i;
            continue;
        }
        if (touch.spans) {
            winding += touch.winding;
        } else {
            if (!std::exchange(hasEnds, true))
                onLeft_.fill(0);
            PlaceRange(row_.heightOf(touch.top), row_.heightOf(touch.bottom)).add(onLeft_, touch.winding);
        }
        active_[i] = active_.back();
        active_.pop_back();
    }
    forgetPieces();
}

/// A square that a single chain touches. False if it does not span the row.
bool SampledRows::drawOne(Touch& touch, std::int32_t square, std::int32_t winding, const Layer& layer) {
    if (!touch.spans)
        return false;
    const bool isLeft = layer.isInside(winding), isRight = layer.isInside(winding + touch.winding);
    if (isLeft == isRight) {
        if (isLeft)
            cover(square, layer);
        return true;
    }
    if (isDarkBeside(touch, square, isLeft))
        return true;
    ++asked_;
    bool isDark = false;
    if (touch.isStraight) {
        findPieces(touch);
        isDark = lights_.coverBeside(square, layer, pieces_[touch.firstPiece].edge, isLeft);
    } else {
        windings_.fill(std::int16_t(winding));
        addTouch(touch, square);
        isDark = lights_.cover(square, layer, windings_);
    }
    if (isDark)
        keepDark(square, touch, isLeft);
    return true;
}

/// Whether the layer is nowhere but between two chains that span the row, and it is dark there.
bool SampledRows::isDarkBetween(const Touch& left, const Touch& right, std::int32_t square,
                                std::int32_t winding, const Layer& layer) const {
    return left.spans && right.spans && left.isStraight && right.isStraight &&
           left.line.enter <= right.line.enter && left.line.leave <= right.line.leave &&
           !layer.isInside(winding) && !layer.isInside(winding + left.winding + right.winding) &&
           (isDarkBeside(right, square, true) || isDarkBeside(left, square, false));
}

/// Calls visit(upper end, lower end, side) from the top on for parts of a chain's edges that are in the
/// square, on its left or on its right. Beside it, they are moved onto its border.
template <class Visit>
void SampledRows::visitParts(const Touch& touch, std::int32_t square, const Visit& visit) const {
    const CutChain& cut = cuts_[touch.cut];
    const auto left = float(square), right = float(square + 1);
    for (std::uint32_t at = cut.at; at < cut.last && vertices_[at].y < row_.bottom; ++at) {
        const glm::vec2 a = row_.inSquares(vertices_[at]), b = row_.inSquares(vertices_[at + 1]), d = b - a;
        if (d.y <= 0 || b.y <= 0)
            continue;
        float ends[4]{std::max(0.0f, -a.y / d.y), 0, 0, std::min(1.0f, (1 - a.y) / d.y)};
        ends[1] = ends[2] = ends[0];
        if (d.x != 0) {
            const auto [first, second] = std::minmax({(left - a.x) / d.x, (right - a.x) / d.x});
            ends[1] = std::clamp(first, ends[0], std::max(ends[0], ends[3]));
            ends[2] = std::clamp(second, ends[0], std::max(ends[0], ends[3]));
        }
        const auto onBorder = [&](glm::vec2 p) { return glm::vec2(std::clamp(p.x, left, right), p.y); };
        for (std::size_t i = 0; i < 3; ++i) {
            if (ends[i] >= ends[i + 1])
                continue;
            const float middle = a.x + 0.5f * (ends[i] + ends[i + 1]) * d.x;
            visit(onBorder(a + ends[i] * d), onBorder(a + ends[i + 1] * d),
                  middle < left    ? Side::Left
                  : middle > right ? Side::Right
                                   : Side::In);
        }
    }
}

/// At all heights of the chain in the row but where it is on one side of the square, left or right.
SampledRows::Apart SampledRows::apartFrom(const RowLine& line, const Touch& touch, std::int32_t square,
                                          Side without) const {
    if (touch.isStraight && touch.spans) {
        const float enter = touch.line.enter - line.enter, leave = touch.line.leave - line.leave;
        return {std::min(enter, leave), std::max(enter, leave)};
    }
    Apart apart{INFINITY, -INFINITY};
    visitParts(touch, square, [&](glm::vec2 a, glm::vec2 b, Side side) {
        if (side == without)
            return;
        for (const glm::vec2 p : {a, b}) {
            apart.least = std::min(apart.least, p.x - line.at(p.y));
            apart.most = std::max(apart.most, p.x - line.at(p.y));
        }
    });
    return apart.least <= apart.most ? apart : Apart{-INFINITY, INFINITY};
}

/// Whether all of a square that is on one side of a chain is known to be dark. Where the chain is beside the
/// square, all of it or nothing is on that side.
bool SampledRows::isDarkBeside(const Touch& touch, std::int32_t square, bool isLeft) const {
    // Mostly the line lies beside the square: nothing of it is known to be dark.
    if (isLeft) {
        const RowLine line = lights_.darkLeft(square);
        return std::max(line.enter, line.leave) > float(square) &&
               apartFrom(line, touch, square, Side::Left).most <= 0;
    }
    const RowLine line = lights_.darkRight(square);
    return std::min(line.enter, line.leave) < float(square + 1) &&
           apartFrom(line, touch, square, Side::Right).least >= 0;
}

/// All is dark on one side of the chain.
void SampledRows::keepDark(std::int32_t square, const Touch& touch, bool isLeft) {
    const Side none = isLeft ? Side::Left : Side::Right, all = isLeft ? Side::Right : Side::Left;
    RowLine line = touch.line;
    if (!touch.isStraight || !touch.spans) {
        glm::vec2 first(0), last(0);  // in the square
        bool isIn = false;
        std::optional<Side> sideAbove, sideBelow;
        visitParts(touch, square, [&](glm::vec2 a, glm::vec2 b, Side side) {
            if (!sideAbove)
                sideAbove = side;
            sideBelow = side;
            if (side != Side::In)
                return;
            if (!std::exchange(isIn, true))
                first = a;
            last = b;
        });
        // Above and below a chain that begins or ends in the row, no place may be on that side of the line.
        const auto isBeside = [&](float x) { return isLeft ? x <= float(square) : x >= float(square + 1); };
        const bool begins = touch.top > row_.top && sideAbove != none,
                   ends = touch.bottom < row_.bottom && sideBelow != none;
        if (last.y - first.y < leastHeight || (begins && !isBeside(first.x)) || (ends && !isBeside(last.x)))
            return;
        const float slope = (last.x - first.x) / (last.y - first.y);
        line = {first.x - first.y * slope, last.x + (1 - last.y) * slope};
    }
    const Apart apart = apartFrom(line, touch, square, all);
    if (isLeft)
        lights_.keepDarkLeft(square, line.movedBy(apart.least));
    else
        lights_.keepDarkRight(square, line.movedBy(apart.most));
}

// ---- Places ---------------------------------------------------------------------------------------

void SampledRows::findPieces(Touch& touch) {
    if (touch.endPiece > touch.firstPiece)
        return;
    touch.firstPiece = std::uint32_t(pieces_.size());
    const auto add = [&](glm::vec2 a, float slope, float bottom) {
        const glm::vec2 from = row_.inSquares(a);
        const float perY = row_.inSquares(slope), to = row_.heightOf(bottom);
        const float enter = from.x + (std::max(from.y, 0.0f) - from.y) * perY,
                    leave = from.x + (std::min(to, 1.0f) - from.y) * perY;
        pieces_.push_back({PlacedEdge(from, perY), PlaceRange(from.y, to),
                           a.y <= row_.top && bottom >= row_.bottom, std::min(enter, leave),
                           std::max(enter, leave)});
    };
    const CutChain& cut = cuts_[touch.cut];
    add(cut.a, cut.slope, cut.edgeBottom);
    for (std::uint32_t at = cut.at + 1; !touch.isStraight && at < cut.last && vertices_[at].y < row_.bottom;
         ++at) {
        const glm::vec2 a = vertices_[at], b = vertices_[at + 1];
        if (a.y < b.y)
            add(a, slopeOf(a, b), b.y);
    }
    touch.endPiece = std::uint32_t(pieces_.size());
}

/// Those of chains that lie on the left, once they are many.
void SampledRows::forgetPieces() {
    if (pieces_.size() < keptPieces + keptForChain * active_.size())
        return;
    kept_.clear();
    for (Touch* touch : active_) {
        const auto first = pieces_.begin() + touch->firstPiece, end = pieces_.begin() + touch->endPiece;
        touch->firstPiece = std::uint32_t(kept_.size());
        kept_.insert(kept_.end(), first, end);
        touch->endPiece = std::uint32_t(kept_.size());
    }
    pieces_.swap(kept_);
}

/// To windings_.
void SampledRows::addTouch(Touch& touch, std::int32_t square) {
    findPieces(touch);
    const auto left = float(square), right = float(square + 1);
    for (const Piece& piece :
         std::span(pieces_).subspan(touch.firstPiece, touch.endPiece - touch.firstPiece)) {
        if (piece.left >= right)
            continue;
        if (piece.spans)
            piece.edge.add(windings_, square, touch.winding);
        else if (piece.right < left)
            piece.range.add(windings_, touch.winding);
        else
            piece.edge.add(windings_, square, touch.winding, piece.range);
    }
}

// ---- Colours --------------------------------------------------------------------------------------

/// The pixels' colours as paints.
void SampledRows::finishRow(float top, float bottom, std::vector<asset::Chord>& chords) {
    const float perHeight = 1 / (bottom - top);
    RegionPaint left = 0;
    glm::vec4 before(0);
    for (int x = 0; x <= width_; ++x) {
        const glm::vec4 sum = x < width_ ? std::exchange(sums_[std::size_t(x)], glm::vec4(0)) : glm::vec4(0);
        const glm::vec4 color = perHeight * sum;
        if (color == before)
            continue;
        const RegionPaint right = state_.paintOf(color);
        chords.push_back({{float(x), top}, {float(x), bottom}, left, right});
        left = right;
        before = color;
    }
}

}  // namespace vtm::compiler

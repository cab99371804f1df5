// Of the level steps: where they are placed in a row.
#include "compiler/direct/line_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "compiler/paint/region_paints.hpp"

namespace vtm::compiler {
namespace {

/// Chains in steps, a row in the mean: what a row may cost.
constexpr double cutsInRow = 200'000;
constexpr std::size_t leastSteps = 2;
/// So many times more steps are taken in a row in which all chains begin or end.
constexpr double moreForEnds = 16;
/// Level sides are long if they are, in the mean, one of so many parts of the width.
constexpr float longSides = 8;
/// So many times more steps are taken where each is drawn as it is.
constexpr std::size_t moreByContent = 2;
/// Contents of parts of a row are equal if their chains are within this many pixels.
constexpr float sameColumn = 1.0f / 1024;

}  // namespace

/// Whether they are placed by content.
bool LineSweep::findSteps(float top, float bottom) {
    isArranged_ = false;
    order_.clear();
    findPieces(top, bottom);
    const std::size_t count = stepsInRow();
    steps_.clear();
    if (placeByContent(top, bottom, count))
        return true;
    const auto placeBetween = [&](float from, float to, std::size_t steps) {
        const float height = (to - from) / float(steps);
        for (std::size_t i = 0; i < steps; ++i)
            steps_.push_back({from + float(i) * height, from + float(i + 1) * height, height});
    };
    const bool areFew = pieces_.size() <= moreByContent * count,
               haveLongSides = levelSides_.length * longSides >= float(pieces_.size()) * float(width_);
    const auto mayEndsDraw = [&] {
        return mayDrawEnds() && pieces_.size() * chainsAmongSides({top, bottom, bottom - top}) <=
                                    endCutsInBand / asset::bandRows;
    };
    if (!haveLongSides || (!areFew && mayEndsDraw())) {
        placeBetween(top, bottom, count);
        return false;
    }
    // No long level side lies within a step.
    if (!areFew) {
        placeByMostContents(top, count);
        return true;
    }
    std::ranges::sort(pieces_, {}, &Piece::top);
    for (const Piece& piece : pieces_) {
        const float share = (piece.bottom - piece.top) / (bottom - top);
        placeBetween(piece.top, piece.bottom, std::max<std::size_t>(std::size_t(share * float(count)), 1));
    }
    return false;
}

std::size_t LineSweep::stepsInRow() const {
    const double ends = double(contentChanges_.size()) / double(cuts_.size() + 1);
    const double most = cutsInRow / costOfCut_ / (meanCut_ + 1);
    return std::clamp(std::size_t(most * (1 + moreForEnds * ends)), leastSteps, mostSteps);
}

/// Cuts the row where chains begin and end.
void LineSweep::findPieces(float top, float bottom) {
    contentChanges_.clear();
    pieces_.clear();
    std::uint64_t content = 0;
    levelSides_ = {};
    // A chain that begins or ends with a level side has that of the layer.
    const auto addSide = [&](glm::vec2 a, glm::vec2 b) {
        if (a.y != b.y)
            return;
        const auto most = float(width_);
        const float left = std::clamp(std::min(a.x, b.x), 0.0f, most),
                    right = std::clamp(std::max(a.x, b.x), 0.0f, most);
        levelSides_.length += right - left;
        levelSides_.left = std::min(levelSides_.left, left);
        levelSides_.right = std::max(levelSides_.right, right);
    };
    for (const CutChain& cut : cuts_) {
        if (cut.spans(top, bottom))
            continue;
        const bool begins = cut.a.y > top;
        const float end = vertices_[cut.last].y;
        if (!begins && end >= bottom)
            continue;
        const auto column = std::int64_t(cut.a.x / sameColumn);
        const std::uint64_t own = hashValue(hashValue(cut.layer) + std::uint64_t(std::int64_t(cut.winding)) +
                                            hashValue(std::uint64_t(column)));
        if (begins) {
            contentChanges_.push_back({cut.a.y, own});
            addSide(vertices_[cut.at], vertices_[cut.at + 1]);
        } else {
            content += own;
        }
        if (end < bottom) {
            contentChanges_.push_back({end, 0 - own});
            addSide(vertices_[cut.last - 1], vertices_[cut.last]);
        }
    }
    std::ranges::sort(contentChanges_, {}, &ContentChange::y);
    for (std::size_t i = 0; i <= contentChanges_.size(); ++i) {
        const float next = i < contentChanges_.size() ? contentChanges_[i].y : bottom;
        if (next > top) {
            pieces_.push_back({top, next, content});
            top = next;
        }
        if (i < contentChanges_.size())
            content += contentChanges_[i].content;
    }
}

/// So many chains that may show lie in the columns of the row's level sides.
std::size_t LineSweep::chainsAmongSides(const Step& row) {
    if (hides_)
        lookForShown(row);
    else
        lookAtAll(row);
    order_.clear();
    return std::size_t(std::ranges::count_if(seen_, [&](const Seen& seen) {
        return seen.right >= levelSides_.left && seen.left <= levelSides_.right;
    }));
}

/// Pieces with the same content share steps. False if contents are too many, or too few are the same.
bool LineSweep::placeByContent(float top, float bottom, std::size_t most) {
    std::ranges::sort(pieces_, [](const Piece& a, const Piece& b) {
        return a.content != b.content ? a.content < b.content : a.top < b.top;
    });
    std::size_t contents = 1;
    for (std::size_t i = 1; i < pieces_.size(); ++i)
        contents += pieces_[i].content != pieces_[i - 1].content;
    if (contents > moreByContent * most || 2 * contents > pieces_.size())
        return false;
    const float part = (bottom - top) / float(std::max<std::size_t>(most / contents, 1));
    for (std::size_t i = 0, end = 0; i < pieces_.size(); i = end) {
        const float to = top + part * (std::floor((pieces_[i].top - top) / part) + 1);
        float height = 0, moment = 0;
        do {  // at least one: `to` may be rounded to its top
            const float own = pieces_[end].bottom - pieces_[end].top;
            height += own;
            moment += own * 0.5f * (pieces_[end].top + pieces_[end].bottom);
            ++end;
        } while (end < pieces_.size() && pieces_[end].content == pieces_[i].content && pieces_[end].top < to);
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

/// The contents that fill most of the row have steps of their own, as many as `most`; of the others as many
/// stand for those near them. Pieces are sorted by content.
void LineSweep::placeByMostContents(float top, std::size_t most) {
    std::vector<Step> contents;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const Piece& piece = pieces_[i];
        const float height = piece.bottom - piece.top;
        if (i == 0 || piece.content != pieces_[i - 1].content) {
            contents.push_back({piece.top, piece.bottom, height});
            continue;
        }
        Step& step = contents.back();
        step.height += height;
        if (height > step.bottom - step.top)
            step = {piece.top, piece.bottom, step.height};
    }
    std::ranges::stable_sort(contents, std::greater(), &Step::height);
    const auto own = std::ptrdiff_t(std::min(most, contents.size()));
    steps_.assign(contents.begin(), contents.begin() + own);
    const std::span others = std::span(contents).subspan(std::size_t(own));
    std::ranges::sort(others, {}, &Step::top);
    const std::size_t parts = std::min(most, others.size());
    const double ahead = std::fmod(double(top) * std::numbers::phi, 1.0);
    for (std::size_t k = 0; k < parts; ++k) {
        const std::span part =
            others.first((k + 1) * others.size() / parts).subspan(k * others.size() / parts);
        Step step = part[std::size_t(ahead * double(part.size()))];
        step.height = 0;
        for (const Step& other : part)
            step.height += other.height;
        steps_.push_back(step);
    }
    std::ranges::sort(steps_, {}, &Step::top);
}

}  // namespace vtm::compiler

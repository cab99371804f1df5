// Of the level steps: columns in which a layer begins or ends, drawn from end to end.
#include "compiler/direct/line_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

/// A level side misplaces no more than the step's height of a pixel, and half of it in the mean: in thinner
/// steps 2/255.
constexpr float thinStep = 1.0f / 60;
/// Where fewer chains begin or end, the steps are thin enough.
constexpr std::size_t manyEnds = 32;
/// Fewer heights tell little more than the step.
constexpr std::size_t fewestHeights = 32;
/// Heights of ends that are nearer are one.
constexpr float sameHeight = 1.0f / 16384;

}  // namespace

/// Between two ends of one layer lies a level side, which no chain tells of.
void LineSweep::findEndedColumns(const Step& step) {
    if (step.height < thinStep)
        return;
    ends_.clear();
    for (const Seen& seen : sorted_)
        if (seen.hasEnd)
            ends_.push_back({seen.layer, seen.left, seen.right});
    if (ends_.size() < manyEnds)
        return;
    std::ranges::sort(ends_, {}, &LayerEnd::layer);
    for (std::size_t i = 0; i < ends_.size();) {
        float left = INFINITY, right = -INFINITY;
        for (const std::uint32_t layer = ends_[i].layer; i < ends_.size() && ends_[i].layer == layer; ++i) {
            left = std::min(left, ends_[i].left);
            right = std::max(right, ends_[i].right);
        }
        if (right >= 0 && left < float(width_))
            endedColumns_.push_back({std::floor(left), std::floor(right) + 1, {}, {}, false});
    }
    std::ranges::sort(endedColumns_, {}, &EndedColumns::left);
    std::size_t last = 0;
    for (std::size_t i = 1; i < endedColumns_.size(); ++i)
        if (endedColumns_[i].left <= endedColumns_[last].right)
            endedColumns_[last].right = std::max(endedColumns_[last].right, endedColumns_[i].right);
        else
            endedColumns_[++last] = endedColumns_[i];
    endedColumns_.resize(std::min(endedColumns_.size(), last + 1));
}

/// Gives the columns the chains that reach into them, and those on their left that are not left of the
/// columns before.
void LineSweep::sortToEndedColumns() {
    // Chains lie beside the picture at its border, where only those matter that begin or end.
    const auto inPicture = [&](float x) { return x < 0 ? -INFINITY : x > float(width_) ? INFINITY : x; };
    const auto isLeftOf = [](float x, const EndedColumns& columns) { return x < columns.left; };
    for (std::uint32_t i = 0; i < sorted_.size(); ++i) {
        const Seen& seen = sorted_[i];
        const float left = seen.hasEnd ? seen.left : inPicture(seen.left),
                    right = seen.hasEnd ? seen.right : inPicture(seen.right);
        const auto after = std::upper_bound(endedColumns_.begin(), endedColumns_.end(), right, isLeftOf);
        if (seen.isAtMiddle && after != endedColumns_.end())
            after->onLeft.push_back(i);
        for (auto columns = after; columns != endedColumns_.begin();) {
            --columns;
            if (left > columns->right)
                break;
            columns->members.push_back(i);
        }
    }
}

/// Heights in the step, from its top to its bottom, between which none of the chains begins or ends.
void LineSweep::findHeights(std::span<const std::uint32_t> members, const Step& step) {
    heights_.assign(1, step.top);
    for (const std::uint32_t i : members) {
        if (!sorted_[i].hasEnd)
            continue;
        const CutChain& cut = cuts_[sorted_[i].cut];
        for (const float y : {vertices_[cut.at].y, vertices_[cut.last].y})
            if (y > step.top && y < step.bottom)
                heights_.push_back(y);
    }
    std::ranges::sort(heights_);
    std::size_t last = 0;
    for (const float y : heights_)
        if (y - heights_[last] > sameHeight)
            heights_[++last] = y;
    heights_.resize(last + 1);
    heights_.push_back(step.bottom);
}

/// Leaves out all but so many, evenly.
void LineSweep::thinHeights(std::size_t most) {
    if (heights_.size() <= most)
        return;
    const std::size_t parts = std::max<std::size_t>(most, 2) - 1, all = heights_.size() - 1;
    for (std::size_t i = 0; i <= parts; ++i)
        heights_[i] = heights_[i * all / parts];
    heights_.resize(parts + 1);
}

/// In the columns where layers begin and end: adds what lies between one end and the next.
void LineSweep::drawEndedColumns(const Step& step) {
    sortToEndedColumns();
    std::size_t mayCost = endCutsInStep_;
    const auto crossAll = [&](std::span<const std::uint32_t> chains, std::int32_t times) {
        for (const std::uint32_t i : chains)
            state_.cross(sorted_[i].layer, times * sorted_[i].winding);
    };
    for (EndedColumns& columns : endedColumns_) {
        crossAll(columns.onLeft, 1);
        findHeights(columns.members, step);
        thinHeights(mayCost / columns.members.size());
        if (heights_.size() < fewestHeights)
            continue;
        const std::size_t cost = columns.members.size() * heights_.size();
        mayCost -= std::min(cost, mayCost);
        endCuts_ -= std::min(cost, endCuts_);
        columns.isDrawn = true;
        glm::vec4 sum = drawFromEndToEnd(columns, step);
        for (int x = columns.first(); x < columns.end(width_); ++x)
            pixelSums_[std::size_t(x)] += sum += std::exchange(fine_[std::size_t(x)], glm::vec4(0));
    }
    for (const EndedColumns& columns : endedColumns_)
        crossAll(columns.onLeft, -1);
}

/// Takes from the columns that are drawn already what the step, whose changes these are, has there.
void LineSweep::leaveOutEndedColumns(std::span<const glm::vec4> changes) {
    glm::vec4 sum(0);
    int x = 0;
    for (const EndedColumns& columns : endedColumns_) {
        if (!columns.isDrawn)
            continue;
        for (; x < columns.first(); ++x)
            sum += changes[std::size_t(x)];
        for (; x < columns.end(width_); ++x)
            pixelSums_[std::size_t(x)] -= sum += changes[std::size_t(x)];
    }
}

/// What changes in the columns becomes `fine_`; returns what is on their left.
glm::vec4 LineSweep::drawFromEndToEnd(const EndedColumns& columns, const Step& step) {
    limits::check();
    std::vector<CutChain> before;
    float leftmost = columns.left, rightmost = columns.right;
    for (const std::uint32_t i : columns.members) {
        const Seen& seen = sorted_[i];
        before.push_back(cuts_[seen.cut]);
        leftmost = std::min(leftmost, seen.left);
        rightmost = std::max(rightmost, seen.right);
    }
    fine_.resize(sums_.size(), glm::vec4(0));
    sums_.swap(fine_);
    Shown left;
    lookHere(left);
    const float scale = step.height / (step.bottom - step.top);
    takePart(columns.members | std::views::transform([&](std::uint32_t i) { return sorted_[i].cut; }));
    for (std::size_t k = 0; k + 1 < heights_.size(); ++k) {
        const Step part{heights_[k], heights_[k + 1], scale * (heights_[k + 1] - heights_[k])};
        lookAtPart(part);
        cross(partSorted_, part, left, -INFINITY, INFINITY);
        for (const Seen& seen : part_)
            if (seen.isAtMiddle)
                state_.cross(seen.layer, -seen.winding);
    }
    sums_.swap(fine_);
    glm::vec4 onLeft = step.height * left.color;
    const auto columnOf = [&](float x) { return std::size_t(std::clamp(x, 0.0f, float(width_))); };
    for (std::size_t x = columnOf(leftmost); x < std::size_t(columns.first()); ++x)
        onLeft += std::exchange(fine_[x], glm::vec4(0));
    std::fill(fine_.begin() + columns.end(width_), fine_.begin() + std::ptrdiff_t(columnOf(rightmost)) + 2,
              glm::vec4(0));
    for (std::size_t i = 0; i < before.size(); ++i)
        cuts_[sorted_[columns.members[i]].cut] = before[i];
    return onLeft;
}

}  // namespace vtm::compiler

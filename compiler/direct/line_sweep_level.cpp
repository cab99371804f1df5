// Of the level steps of one colour: columns that nearly level edges cross, drawn in thinner ones.
#include "compiler/direct/line_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

/// So many columns are drawn together.
constexpr int columnsTogether = 16;
/// Of all columns of a row.
constexpr std::size_t mostMembers = 1u << 22;
/// In so many steps, at most, in each of which all of their chains are looked at: so many of them in a row.
constexpr std::size_t mostThinSteps = 256, cutsInThinSteps = 1'024'000;
/// Fewer steps tell no more than the row's.
constexpr std::size_t timesMore = 2, fewestThinSteps = 8;

}  // namespace

/// Finds which chains reach into which columns, and the winding numbers on their left. False if there are too
/// many.
bool LineSweep::sortToLevelColumns(float top, float bottom) {
    const int count = (width_ + columnsTogether - 1) / columnsTogether;
    levelColumns_.assign(std::size_t(count), {});
    std::vector<std::int32_t> windings(std::size_t(count) + 1);
    std::size_t members = 0;
    const auto at = [&](float x) {
        return int(std::clamp(std::floor(x / columnsTogether), -1.0f, float(count)));
    };
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
        Seen seen;
        look(i, {top, bottom, bottom - top}, seen);
        // What begins or ends is on the left of columns for a part of the row only.
        const int first = seen.hasEnd ? 0 : std::max(at(seen.left), 0),
                  last = seen.hasEnd ? count - 1 : std::min(at(seen.right), count - 1);
        members += std::size_t(std::max(last + 1 - first, 0));
        if (members > mostMembers)
            return false;
        for (int c = first; c <= last; ++c)
            levelColumns_[std::size_t(c)].members.push_back(std::uint32_t(i));
        if (!seen.hasEnd)
            windings[std::size_t(std::min(at(seen.right) + 1, count))] += seen.winding;
        const bool isLevel = seen.right - seen.left > levelReach;
        for (int c = first; isLevel && c <= last; ++c)
            levelColumns_[std::size_t(c)].isLevel = true;
    }
    std::int32_t winding = 0;
    for (std::size_t c = 0; c < levelColumns_.size(); ++c)
        levelColumns_[c].winding = winding += windings[c];
    return true;
}

/// Replaces what the row's steps have in columns that nearly level edges cross, as far as thinner ones tell
/// more.
void LineSweep::drawLevelColumns(float top, float bottom) {
    if (!sortToLevelColumns(top, bottom))
        return;
    const std::size_t share = cutsInThinSteps / levelColumns_.size();
    float value = 0, before = 0;
    std::size_t x = 0;
    const auto put = [&](float now) { shares_[x++] = now - std::exchange(before, now); };
    for (std::size_t c = 0; c < levelColumns_.size(); ++c) {
        const LevelColumns& columns = levelColumns_[c];
        const std::size_t first = c * columnsTogether,
                          end = std::min(first + columnsTogether, std::size_t(width_)),
                          steps = std::min(mostThinSteps, share / (columns.members.size() + 1));
        const bool isFiner = columns.isLevel && steps >= std::max(fewestThinSteps, timesMore * steps_.size());
        if (isFiner)
            drawInThinSteps(columns, first, end, steps, top, bottom);
        while (x < end) {
            value += shares_[x];
            put(isFiner ? levelShares_[x - first] : value);
        }
    }
    while (x < shares_.size()) {
        value += shares_[x];
        put(value);
    }
}

/// The inside's part of each of the columns becomes `levelShares_`, times the row's height.
void LineSweep::drawInThinSteps(const LevelColumns& columns, std::size_t first, std::size_t end,
                                std::size_t steps, float top, float bottom) {
    limits::check();
    std::vector<Cut> before;
    for (const std::uint32_t i : columns.members)
        before.push_back(cuts_[i]);
    const std::int32_t mask = isEvenOdd_ ? 1 : -1;
    const float height = (bottom - top) / float(steps);
    levelChanges_.assign(shares_.size(), 0);
    float share = (columns.winding & mask) != 0 ? bottom - top : 0;
    takePart(columns.members);
    for (std::size_t k = 0; k < steps; ++k) {
        const Step step{top + float(k) * height, top + float(k + 1) * height, height};
        lookAtPart(step);
        winding_ = columns.winding;
        addOutline(partSorted_, height, levelChanges_);
    }
    for (std::size_t i = 0; i < before.size(); ++i)
        cuts_[columns.members[i]] = before[i];
    for (std::size_t x = 0; x < first; ++x)
        share += levelChanges_[x];
    levelShares_.clear();
    for (std::size_t x = first; x < end; ++x)
        levelShares_.push_back(share += levelChanges_[x]);
}

}  // namespace vtm::compiler

#include "conformance/reference/coverage/sweep.hpp"
#include <vtm/limits/limits.hpp>

#include <numeric>

namespace vtm::reference {
namespace {

/// Edges in the wrong order by less than this (pixels) count as ordered: coincident edges, cut at
/// different points, differ by rounding. The area at stake is as small.
constexpr double orderTolerance = 1e-11;
/// Levels closer than this (pixels) are one: a strip so thin holds no area worth finding, and piles of
/// edges that differ by rounding alone would make thousands.
constexpr double thinnestStrip = 1e-10;
/// Strips with more crossings than this are cut into as many of equal height instead. Only piles of
/// thousands of edges in a pixel get there; the error is within one strip, 1/4096 pixel, around each
/// crossing.
constexpr std::size_t maxCrossings = 4096;

bool startsAbove(const EdgePart& part, int y) { return part.ya == y && part.yb > part.ya; }

/// The height at which a part crosses the vertical line x.
double heightAt(const EdgePart& p, double x) {
    const double y = p.ya + (x - p.xa) / (p.xb - p.xa) * (p.yb - p.ya);
    return std::clamp(y, p.ya, p.yb);
}

/// Of levels close together the last one stays: below it all of their edges have begun or ended.
void mergeLevels(std::vector<double>& levels) {
    std::sort(levels.begin(), levels.end());
    std::size_t kept = 0;
    double first = levels[0];
    for (const double level : levels) {
        if (level - first >= thinnestStrip) {
            ++kept;
            first = level;
        }
        levels[kept] = level;
    }
    levels.resize(kept + 1);
}

int columnOf(double x, int width) { return int(std::floor(std::clamp(x, -1.0, double(width)))); }

}  // namespace

void cutToRow(std::span<const Edge> edges, int y, std::vector<EdgePart>& parts) {
    for (const Edge& e : edges) {
        if (e.y0 >= y + 1 || e.y1 <= y)
            continue;
        const double ya = std::max(e.y0, double(y)), yb = std::min(e.y1, y + 1.0);
        parts.push_back({e.xAt(ya), ya, e.y1 > yb ? e.xAt(yb) : e.x1, yb, e.shape, e.winding});
    }
}

double RowSweep::Side::xAt(double y) const {
    if (y <= yt)
        return xt;
    return y >= yb ? xb : xt + (y - yt) / (yb - yt) * (xb - xt);
}

void RowSweep::sweep(std::span<const EdgePart> parts, int y, Regions& regions) {
    startRow(parts, y, regions);
    sortIntoColumns(parts);
    int uniform = 0;  // columns before it are done
    for (int column = first_; column <= last_; ++column) {
        const auto* begin = &begins_[std::size_t(column - first_)];
        if (begin[0] == begin[1])
            continue;
        if (uniform < column)
            regions.run(uniform, column);
        pixel(parts, {members_.data() + begin[0], members_.data() + begin[1]}, column, y, regions);
        uniform = column + 1;
    }
    if (uniform < width_)
        regions.run(uniform, width_);
    finishRow(regions);
}

/// The windings at the row's top left corner: of edges that start their way through the row left of it.
void RowSweep::startRow(std::span<const EdgePart> parts, int y, Regions& regions) {
    for (const EdgePart& part : parts)
        if (startsAbove(part, y) && part.xa < 0)
            cross(part.shape, part.winding, regions);
}

void RowSweep::finishRow(Regions& regions) {
    for (const auto& [shape, winding] : windings_)
        regions.cross(shape, -winding);
    windings_.clear();
}

void RowSweep::cross(int shape, int winding, Regions& regions) {
    regions.cross(shape, winding);
    windings_.emplace_back(shape, winding);
}

/// A counting sort of the parts by the columns that they meet.
void RowSweep::sortIntoColumns(std::span<const EdgePart> parts) {
    const auto columns = [&](const EdgePart& p) {
        return std::pair{std::max(0, columnOf(std::min(p.xa, p.xb), width_)),
                         std::min(width_ - 1, columnOf(std::max(p.xa, p.xb), width_))};
    };
    first_ = width_;
    last_ = -1;
    for (const EdgePart& part : parts) {
        const auto [begin, end] = columns(part);
        if (begin > end)
            continue;
        first_ = std::min(first_, begin);
        last_ = std::max(last_, end);
    }
    begins_.assign(std::size_t(std::max(0, last_ - first_ + 1)) + 2, 0);
    const auto eachColumn = [&](const auto& act) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto [begin, end] = columns(parts[i]);
            for (int c = begin; c <= end; ++c)
                act(i, std::size_t(c - first_));
        }
    };
    eachColumn([&](std::size_t, std::size_t c) { ++begins_[c + 2]; });
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    members_.resize(std::size_t(begins_.back()));
    eachColumn([&](std::size_t i, std::size_t c) { members_[std::size_t(begins_[c + 1]++)] = int(i); });
}

void RowSweep::pixel(std::span<const EdgePart> parts, std::span<const int> members, int column, int y,
                     Regions& regions) {
    sides_.clear();
    entries_.clear();
    for (const int i : members)
        cutToPixel(parts[std::size_t(i)], column);
    collectStrips(y);
    std::size_t nextEntry = 0, nextSide = 0;
    active_.clear();
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
        limits::check();
        const double y0 = levels_[i], y1 = levels_[i + 1];
        enterThrough(y0, nextEntry, regions);
        for (; nextSide < sides_.size() && sides_[nextSide].yt <= y0; ++nextSide)
            active_.push_back(&sides_[nextSide]);
        std::erase_if(active_, [&](const Side* side) { return side->yb <= y0; });
        strip(y0, y1, column, regions);
    }
    for (std::size_t i = 0; i < nextEntry; ++i)
        regions.cross(entries_[i].shape, -entries_[i].winding);
    for (const int i : members) {  // on to the next pixel's corner
        const EdgePart& part = parts[std::size_t(i)];
        if (startsAbove(part, y) && columnOf(part.xa, width_) == column)
            cross(part.shape, part.winding, regions);
    }
}

/// Going down a pixel's left side, an edge that runs to the right takes its winding away: the edge's
/// winding counts for what lies to its right when it runs down.
void RowSweep::cutToPixel(const EdgePart& part, int column) {
    Side side{part.xa, part.ya, part.xb, part.yb, part.shape, part.winding};
    const double left = column, right = column + 1.0;
    if ((part.xa < left) != (part.xb < left)) {
        const double y = heightAt(part, left);
        entries_.push_back({y, part.shape, part.xa < left ? -part.winding : part.winding});
        (part.xa < left ? side.xt : side.xb) = left;
        (part.xa < left ? side.yt : side.yb) = y;
    }
    if ((part.xa < right) != (part.xb < right)) {
        (part.xa < right ? side.xb : side.xt) = right;
        (part.xa < right ? side.yb : side.yt) = heightAt(part, right);
    }
    if (side.yt < side.yb)
        sides_.push_back(side);
}

void RowSweep::collectStrips(int y) {
    std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.yt < b.yt; });
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.y < b.y; });
    levels_ = {double(y), y + 1.0};
    for (const Side& side : sides_) {
        levels_.push_back(side.yt);
        levels_.push_back(side.yb);
    }
    for (const Entry& entry : entries_)
        levels_.push_back(entry.y);
    mergeLevels(levels_);
}

void RowSweep::enterThrough(double y, std::size_t& next, Regions& regions) {
    for (; next < entries_.size() && entries_[next].y <= y; ++next)
        regions.cross(entries_[next].shape, entries_[next].winding);
}

/// All active sides pass through the whole strip, but for less than `thinnestStrip` at its bottom.
void RowSweep::strip(double y0, double y1, int column, Regions& regions) {
    if (!findCrossings(y0, y1))
        return emitStrip(y0, y1, column, regions);
    std::vector<double> levels = crossings_;
    if (levels.size() > maxCrossings) {
        levels.resize(maxCrossings);
        for (std::size_t i = 0; i < maxCrossings; ++i)
            levels[i] = y0 + (y1 - y0) * double(i) / double(maxCrossings);
    }
    std::sort(levels.begin(), levels.end());
    double top = y0;
    for (const double level : levels) {
        if (level - top < thinnestStrip)
            continue;
        orderedStrip(top, level, column, regions);
        top = level;
    }
    orderedStrip(top, y1, column, regions);
}

/// Orders the active sides by x at the top of the strip; an insertion sort to their order at the bottom
/// swaps just those that cross in between.
bool RowSweep::findCrossings(double y0, double y1) {
    crossers_.clear();
    for (const Side* side : active_)
        crossers_.push_back({side->xAt(y0), side->xAt(y1), side});
    std::sort(crossers_.begin(), crossers_.end(), [](const Crosser& a, const Crosser& b) {
        return a.x0 < b.x0 || (a.x0 == b.x0 && a.x1 < b.x1);
    });
    crossings_.clear();
    for (std::size_t i = 1; i < crossers_.size() && crossings_.size() <= maxCrossings; ++i) {
        for (std::size_t k = i; k > 0 && crossers_[k - 1].x1 > crossers_[k].x1 + orderTolerance; --k) {
            const Crosser &a = crossers_[k - 1], &b = crossers_[k];
            const double above = b.x0 - a.x0, below = a.x1 - b.x1;
            crossings_.push_back(y0 + (y1 - y0) * std::clamp(above / (above + below), 0.0, 1.0));
            std::swap(crossers_[k - 1], crossers_[k]);
        }
    }
    return !crossings_.empty();
}

void RowSweep::orderedStrip(double y0, double y1, int column, Regions& regions) {
    crossers_.clear();
    for (const Side* side : active_)
        crossers_.push_back({side->xAt(y0), side->xAt(y1), side});
    std::sort(crossers_.begin(), crossers_.end(),
              [](const Crosser& a, const Crosser& b) { return a.x0 + a.x1 < b.x0 + b.x1; });
    emitStrip(y0, y1, column, regions);
}

/// `crossers_` in their order.
void RowSweep::emitStrip(double y0, double y1, int column, Regions& regions) {
    double left0 = column, left1 = column;
    for (const Crosser& crosser : crossers_) {
        regions.part(column, {y0, y1, left0, left1, crosser.x0, crosser.x1});
        regions.cross(crosser.side->shape, crosser.side->winding);
        left0 = crosser.x0;
        left1 = crosser.x1;
    }
    regions.part(column, {y0, y1, left0, left1, column + 1.0, column + 1.0});
    for (const Crosser& crosser : crossers_)
        regions.cross(crosser.side->shape, -crosser.side->winding);
}

}  // namespace vtm::reference

#include "compiler/lower/outlines_ahead.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vtm/compiler/compile.hpp>
#include <vtm/limits/limits.hpp>

namespace vtm::compiler {
namespace {

/// In commands of paths filled; of strokes each counts several times. A thread takes a chunk at a time; fewer
/// than `minWork` are not worth the threads; more than `batchWork` are not held at once.
constexpr std::size_t chunkWork = 256, minWork = 1024, batchWork = 1u << 15;
/// Once there are more the rest is left to the walk, which knows the limits.
constexpr std::size_t manyPoints = 1u << 22;

const scene::StrokeStyle* strokeOf(const scene::Item& item) {
    return std::get_if<scene::StrokeStyle>(&item.geometry);
}

std::size_t workOf(const scene::Item& item) {
    constexpr std::size_t perStroked = 8;
    return 1 + item.path->size() * (strokeOf(item) ? perStroked : 1);
}

/// Whether the stroke right above a fill may have an outline for it.
bool mayShare(const scene::Item& fill, const scene::Node* above) {
    const auto* next = above ? std::get_if<scene::Item>(&above->value) : nullptr;
    return next && !strokeOf(fill) && strokeOf(*next) && next->path == fill.path;
}

}  // namespace

OutlinesAhead::OutlinesAhead(const scene::Group& root, const scene::Affine& outer, Make make)
    : outer_(outer), make_(std::move(make)), isParallel_(tbb::this_task_arena::max_concurrency() > 1) {
    collect(root);
}

std::size_t OutlinesAhead::leastPoints() const {
    constexpr std::size_t asked = 64, few = 64 * asked;
    if (items_.size() < few)
        return 0;
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < asked; ++i) {
        Outlines outlines;
        try {
            make_(outlines, originOf(*items_[i * items_.size() / asked]));
        } catch (const LimitError&) {
            outlines.points.clear();
        }
        points.push_back(outlines.points.size());
    }
    // Half of them have no fewer than the median.
    const auto median = points.begin() + asked / 2;
    std::ranges::nth_element(points, median);
    return *median * (items_.size() / 2);
}

void OutlinesAhead::collect(const scene::Group& group) {
    limits::check();
    for (std::size_t i = 0; i < group.children.size(); ++i) {
        const scene::Node& node = group.children[i];
        if (const auto* item = std::get_if<scene::Item>(&node.value)) {
            const scene::Node* above = i + 1 < group.children.size() ? &group.children[i + 1] : nullptr;
            if (!std::holds_alternative<scene::Pattern>(item->paint) && !mayShare(*item, above))
                items_.push_back(item);
        } else if (const auto* select = std::get_if<scene::Select>(&node.value)) {
            for (const auto& side : {select->inside, select->outside})
                if (side)
                    collect(*side);
        } else {
            collect(std::get<scene::Group>(node.value));
        }
    }
    if (group.mask)
        collect(*group.mask->content);
}

OutlineOrigin OutlinesAhead::originOf(const scene::Item& item) const {
    const scene::Affine transform =
        outer_ == scene::identity ? item.transform : scene::compose(outer_, item.transform);
    return {item.path, transform, strokeOf(item)};
}

bool OutlinesAhead::matches(std::size_t item, const OutlineOrigin& origin) const {
    return items_[item]->path == origin.path && strokeOf(*items_[item]) == origin.stroke &&
           originOf(*items_[item]).transform == origin.transform;
}

std::optional<OutlinesAhead::Made> OutlinesAhead::take(const OutlineOrigin& origin) {
    constexpr std::size_t maxPassedOver = 32;
    if (!isParallel_)
        return std::nullopt;
    const std::size_t last = std::min(next_ + maxPassedOver, items_.size());
    for (std::size_t i = next_; i < last; ++i) {
        if (!matches(i, origin))
            continue;
        next_ = i;
        if (next_ >= end_)
            makeBatch();
        ++next_;
        return made_[i - first_];
    }
    return std::nullopt;
}

void OutlinesAhead::makeBatch() {
    first_ = end_ = next_;
    chunks_.clear();
    std::size_t work = 0, inChunk = chunkWork;
    for (; end_ < items_.size() && work < batchWork; ++end_) {
        if (inChunk >= chunkWork) {
            chunks_.push_back({end_, end_, {}});
            inChunk = 0;
        }
        inChunk += workOf(*items_[end_]);
        work += workOf(*items_[end_]);
        chunks_.back().end = end_ + 1;
    }
    made_.assign(end_ - first_, std::nullopt);
    points_ = 0;
    if (work < minWork || chunks_.size() < 2)
        return;
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&, holding = limits::current()](std::size_t i) {
        const limits::Scope scope(holding);
        makeChunk(chunks_[i]);
    });
}

void OutlinesAhead::makeChunk(Chunk& chunk) {
    Outlines& outlines = chunk.outlines;
    for (std::size_t i = chunk.first; i < chunk.end && points_ < manyPoints; ++i) {
        const OutlineOrigin origin = originOf(*items_[i]);
        const limits::Place place = items_[i]->place;
        const limits::Stage stage(origin.stroke ? "stroking" : "flattening", place);
        const std::size_t points = outlines.points.size(), runs = outlines.runs.size();
        try {
            const auto sides = make_(outlines, origin);
            made_[i - first_] = {&outlines,
                                 points,
                                 outlines.points.size() - points,
                                 {std::uint32_t(runs), std::uint32_t(outlines.runs.size() - runs)},
                                 sides};
            points_ += outlines.points.size() - points;
        } catch (const LimitError&) {
            outlines.points.resize(points);
            outlines.runs.resize(runs);
        }
    }
}

RunRange append(const OutlinesAhead::Made& made, Outlines& to) {
    const RunRange runs{std::uint32_t(to.runs.size()), made.runs.count};
    if (to.points.size() + made.pointCount > to.points.capacity())
        limits::need(2 * to.points.capacity() * sizeof(LatticePoint));
    const auto moved = std::uint32_t(to.points.size() - made.firstPoint);  // modulo 2^32
    const auto firstPoint = made.in->points.begin() + std::ptrdiff_t(made.firstPoint);
    to.points.insert(to.points.end(), firstPoint, firstPoint + std::ptrdiff_t(made.pointCount));
    for (std::uint32_t r = made.runs.first; r < made.runs.first + made.runs.count; ++r)
        to.runs.push_back({made.in->runs[r].first + moved, made.in->runs[r].last + moved});
    return runs;
}

}  // namespace vtm::compiler

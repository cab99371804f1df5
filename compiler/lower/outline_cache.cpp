#include "compiler/lower/outline_cache.hpp"

#include "compiler/containers/hash.hpp"

namespace vtm::compiler {

Outlines OutlineCache::take() {
    lastOrder_.swap(order_);
    order_.clear();
    next_ = nextKnown_ = 0;
    added_ = usedRuns_ = usedPoints_ = 0;
    return std::move(outlines_);
}

bool OutlineCache::matches(const Entry& e, const OutlineOrigin& o) {
    return e.path == o.path && e.transform == o.transform &&
           (o.stroke ? e.stroke && *e.stroke == *o.stroke : !e.stroke);
}

/// Strokes of one path under one transform share a value.
std::size_t OutlineCache::hash(const OutlineOrigin& o) {
    std::uint64_t h = hashCombine(reinterpret_cast<std::uintptr_t>(o.path.get()), o.stroke != nullptr);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row)
            h = hashCombine(h, bits(o.transform[column][row] + 0.0));  // -0 is 0
    return h;
}

RunRange OutlineCache::use(std::uint32_t entry) {
    Entry& e = entries_[entry];
    e.place = static_cast<std::uint32_t>(order_.size());
    order_.push_back(entry);
    usedRuns_ += e.runs.count;
    usedPoints_ += e.points;
    return e.runs;
}

std::optional<RunRange> OutlineCache::find(const OutlineOrigin& origin) {
    if (next_ < lastOrder_.size() && matches(entries_[lastOrder_[next_]], origin))
        return use(lastOrder_[next_++]);
    const auto [begin, end] = index_.equal_range(hash(origin));
    for (auto i = begin; i != end; ++i)
        if (matches(entries_[i->second], origin)) {
            next_ = entries_[i->second].place + 1;
            return use(i->second);
        }
    return std::nullopt;
}

void OutlineCache::add(const OutlineOrigin& origin, RunRange runs, std::uint32_t points) {
    const auto number = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({origin.path, origin.transform,
                        origin.stroke ? std::optional(*origin.stroke) : std::nullopt, runs, points, 0});
    index_.emplace(hash(origin), number);
    paths_.emplace(origin.path.get(), number);
    ++added_;
    use(number);
}

bool OutlineCache::knows(const scene::Path& path) {
    if (nextKnown_ < order_.size() && entries_[order_[nextKnown_]].path.get() == &path) {
        ++nextKnown_;
        return true;
    }
    const auto found = paths_.find(&path);
    if (found == paths_.end())
        return false;
    nextKnown_ = entries_[found->second].place + 1;
    return true;
}

bool OutlineCache::isWorn(const Outlines& store) const {
    /// Beyond this factor; seldom enough to be paid for by the edits in between.
    constexpr std::size_t factor = 4, fewPoints = 1u << 16, fewOutlines = 1u << 12;
    return store.points.size() > factor * usedPoints_ + fewPoints ||
           entries_.size() > factor * order_.size() + fewOutlines;
}

std::shared_ptr<const scene::Path> OutlineCache::rectangle(scene::Point min, scene::Point max) {
    auto& path = rectangles_[{min.x, min.y, max.x, max.y}];
    if (!path)
        path = std::make_shared<const scene::Path>(scene::rectangle(min, max));
    return path;
}

}  // namespace vtm::compiler

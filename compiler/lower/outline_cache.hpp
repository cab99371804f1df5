/// \file
/// Outlines on the lattice, kept from one lowering to the next by what they were made from.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include <vtm/scene/affine.hpp>
#include <vtm/scene/path.hpp>
#include <vtm/scene/stroke.hpp>
#include "compiler/lower/outline.hpp"

namespace vtm::compiler {

/// What an outline follows from, the lattice and the tolerance being given.
struct OutlineOrigin {
    const std::shared_ptr<const scene::Path>& path;
    scene::Affine transform;
    const scene::StrokeStyle* stroke = nullptr;  ///< null: filled
};

struct RunRange {
    std::uint32_t first = 0, count = 0;
};

/// Paths are the same if their pointers are; the cache keeps them alive. What is no longer used stays in
/// the store until the cache is thrown away (Session).
class OutlineCache {
public:
    /// Begins a lowering: hands out the store, to which the caller appends.
    Outlines take();
    /// Brings it back.
    void put(Outlines outlines) { outlines_ = std::move(outlines); }

    std::optional<RunRange> find(const OutlineOrigin& origin);
    /// `points`: how many of the store's the outline takes.
    void add(const OutlineOrigin& origin, RunRange runs, std::uint32_t points);

    /// Equal for equal origins; strokes are told from fills, not from each other.
    static std::size_t hash(const OutlineOrigin& origin);

    /// One path for each rectangle.
    std::shared_ptr<const scene::Path> rectangle(scene::Point min, scene::Point max);
    /// How many were added in this lowering.
    std::size_t added() const { return added_; }
    /// How many it used, those included.
    std::size_t used() const { return order_.size(); }
    /// Runs of those that it used.
    std::size_t usedRuns() const { return usedRuns_; }
    /// Whether most of the outlines in the store are no longer used.
    bool isWorn(const Outlines& store) const;
    /// Whether an outline of the path is there; fast if it follows the one asked for before.
    bool knows(const scene::Path& path);

private:
    struct Entry {
        std::shared_ptr<const scene::Path> path;
        scene::Affine transform;
        std::optional<scene::StrokeStyle> stroke;
        RunRange runs;
        std::uint32_t points;
        std::uint32_t place;  ///< in the order of the last lowering that used it
    };
    static bool matches(const Entry& entry, const OutlineOrigin& origin);
    RunRange use(std::uint32_t entry);

    Outlines outlines_;
    std::vector<Entry> entries_;
    std::unordered_multimap<std::size_t, std::uint32_t> index_;
    std::unordered_map<const scene::Path*, std::uint32_t> paths_;  ///< an entry of each
    std::map<std::array<double, 4>, std::shared_ptr<const scene::Path>> rectangles_;
    /// Entries in the order in which the last lowering and this one asked for them. Most are asked for in
    /// the same order again, so the next one is tried before the index.
    std::vector<std::uint32_t> lastOrder_, order_;
    std::uint32_t next_ = 0;       ///< in lastOrder_
    std::uint32_t nextKnown_ = 0;  ///< in order_
    std::size_t added_ = 0, usedRuns_ = 0, usedPoints_ = 0;
};

}  // namespace vtm::compiler

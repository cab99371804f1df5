/// \file
/// Outlines of a scene's items, made on all processors before the walk asks for them, some items at a time.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "compiler/lower/outline.hpp"
#include "compiler/lower/outline_cache.hpp"

namespace vtm::compiler {

/// For walks in painter's order. What a walk passes over costs time only.
class OutlinesAhead {
public:
    /// Appends the outline of what it is given and returns what addStroke() does, or nothing. Called by
    /// several threads at once. Outlines for which it throws LimitError are left to the walk.
    using Make = std::function<std::optional<std::uint32_t>(Outlines&, const OutlineOrigin&)>;

    /// Of all items below `root` whose paints are no patterns, under `outer`. The scene must outlive this.
    OutlinesAhead(const scene::Group& root, const scene::Affine& outer, Make make);

    /// An outline among others.
    struct Made {
        const Outlines* in = nullptr;
        std::size_t firstPoint = 0, pointCount = 0;
        RunRange runs;
        std::optional<std::uint32_t> sides;  ///< what Make returned
    };
    /// Nothing if it was not made. Valid until the next call.
    std::optional<Made> take(const OutlineOrigin& origin);

    /// How many points all outlines have, at least, as far as some of them tell; 0 where items are few.
    std::size_t leastPoints() const;

private:
    struct Chunk {
        std::size_t first = 0, end = 0;  ///< of items_
        Outlines outlines;
    };

    void collect(const scene::Group& group);
    void makeBatch();
    void makeChunk(Chunk& chunk);
    OutlineOrigin originOf(const scene::Item& item) const;
    bool matches(std::size_t item, const OutlineOrigin& origin) const;

    const scene::Affine outer_;
    const Make make_;
    const bool isParallel_;
    std::vector<const scene::Item*> items_;  ///< in the walk's order
    std::size_t next_ = 0;                   ///< of items_: the one to be asked for next
    std::size_t first_ = 0, end_ = 0;        ///< of items_: those that were made last
    std::vector<Chunk> chunks_;              ///< of these
    std::vector<std::optional<Made>> made_;  ///< of these
    std::atomic<std::size_t> points_ = 0;    ///< of these
};

/// Appends a copy. Returns its runs.
RunRange append(const OutlinesAhead::Made& made, Outlines& to);

}  // namespace vtm::compiler

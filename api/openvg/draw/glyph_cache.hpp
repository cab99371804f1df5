/// \file
/// Coverage of glyphs that are drawn again: by mask, matrix and place within a pixel.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <list>
#include <map>
#include <vector>

#include "api/openvg/draw/path_mask.hpp"

namespace vtm::openvg {

class GlyphCache {
public:
    /// Like mask.scan(), but places are rounded to 1/1024 of a pixel: no coverage is off by more than half of
    /// that along each axis.
    void scan(PathMask& mask, const glm::mat3& toSurface, const Rectangle& clip, const RowSink& row);

private:
    struct Key {
        std::uint64_t mask;
        std::array<float, 4> matrix;  ///< without its translation
        std::array<int, 2> phase;     ///< in 1024ths of a pixel

        glm::mat3 toPixel() const;

        friend auto operator<=>(const Key&, const Key&) = default;
    };
    /// Runs, and where those of each row begin; columns and rows from the pixel that the origin is in.
    struct Coverage {
        struct Row {
            int y;
            std::size_t first;
        };
        std::vector<Row> rows;
        std::vector<CoverageRun> runs;

        std::size_t bytes() const { return sizeof(Row) * rows.size() + sizeof(CoverageRun) * runs.size(); }
    };
    struct Entry;
    using Entries = std::list<Entry>;
    struct Entry {
        std::map<Key, Entries::iterator>::iterator place;
        Coverage coverage;
    };

    static Coverage scanned(PathMask& mask, const glm::mat3& toPixel, const Rectangle& box);
    const Coverage& add(const Key& key, Coverage coverage);
    /// Gives what is covered, moved by whole pixels.
    void play(const Coverage& coverage, int left, int bottom, const Rectangle& clip, const RowSink& row);

    Entries entries_;  ///< the last used first
    std::map<Key, Entries::iterator> found_;
    std::size_t bytes_ = 0;
    std::vector<CoverageRun> moved_;
};

}  // namespace vtm::openvg

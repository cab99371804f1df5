/// \file
/// Coverage of glyphs that are drawn again: by mask, matrix and place within a pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "api/openvg/draw/edge_mixer.hpp"
#include "api/openvg/draw/flat_ground.hpp"
#include "api/openvg/draw/path_mask.hpp"

namespace vtm::openvg {

/// What a glyph covers. Columns and rows are counted from the lower left corner of its box.
class GlyphCoverage {
public:
    /// The most that a box has along a side.
    static constexpr int maxSide = 64;
    static_assert(maxSide * maxSide <= int(FlatGround::maxGroups * FlatGround::groupPixels));

    /// Pixels that are all covered.
    struct Run {
        std::uint8_t first, end, y;
    };

    GlyphCoverage(PathMask& mask, const glm::mat3& toPixel, const Rectangle& box);

    /// Around all of it, from the pixel on in which the glyph's origin is.
    const Rectangle& box() const { return box_; }
    /// Row by row, from left to right.
    std::span<const EdgePixel> edges() const { return edges_; }
    std::span<const Run> runs() const { return runs_; }
    /// What comes out on a ground of one colour.
    FlatGround& ground() { return ground_; }
    /// Calls row(y, shares) for the rows in which something is covered: the shares of all pixels, as a
    /// FlatGround takes them.
    template <class Row>
    void forEachRow(Row&& row) const;
    /// The most that it may take.
    std::size_t bytes() const;

    /// Gives the rows as PathMask::scan() does, moved by whole pixels.
    void play(int left, int bottom, const Rectangle& clip, const RowSink& row) const;

private:
    Rectangle box_;
    std::vector<EdgePixel> edges_;
    std::vector<Run> runs_;
    FlatGround ground_;
    std::size_t groupCount_ = 0;  ///< that ground_ may have
};

template <class Row>
void GlyphCoverage::forEachRow(Row&& row) const {
    play(-box_.x0, -box_.y0, {0, 0, maxSide, maxSide}, [&](int y, std::span<const CoverageRun> runs) {
        std::array<std::uint16_t, maxSide + FlatGround::groupPixels> shares{};
        for (const CoverageRun& run : runs)
            std::fill(shares.begin() + run.first, shares.begin() + run.end,
                      std::uint16_t(std::min(fixedShare(run.share), unsigned(FlatGround::whole))));
        row(y, std::span<const std::uint16_t>(shares));
    });
}

/// A glyph on a surface: the pixel that its origin is in.
struct PlacedGlyph {
    GlyphCoverage* coverage;
    int left, bottom;

    /// On the surface, within `clip`.
    void play(const Rectangle& clip, const RowSink& row) const { coverage->play(left, bottom, clip, row); }
};

class GlyphCache {
public:
    /// Finds or keeps a glyph's coverage, good until trim(), and adds it to others. Places are rounded to
    /// 1/1024 of a pixel: no coverage is off by more than half of that along each axis. False for those that
    /// are not kept.
    bool place(PathMask& mask, const glm::mat3& toSurface, const Rectangle& clip,
               std::vector<PlacedGlyph>& placed);
    /// Forgets what was not drawn longest, if it is too much.
    void trim();

private:
    struct Key {
        std::uint64_t mask;
        std::array<std::uint64_t, 2> columns;  ///< of the matrix, as bits, without its translation
        std::uint32_t phase;                   ///< both places within a pixel, in 1024ths

        bool operator==(const Key& o) const {
            return mask == o.mask && columns[0] == o.columns[0] && columns[1] == o.columns[1] &&
                   phase == o.phase;
        }
    };
    struct Entry {
        Key key;
        GlyphCoverage coverage;
        std::uint64_t used;
        Entry* next = nullptr;  ///< what was placed after it: text mostly is drawn as before
    };
    /// Of a table with open addressing.
    struct Slot {
        std::uint64_t hash = 0;
        Entry* entry = nullptr;
    };

    static std::uint64_t hash(const Key& key);
    Entry* find(const Key& key, std::uint64_t hash) const;
    PlacedGlyph use(Entry& entry, int left, int bottom);
    void insert(std::uint64_t hash, Entry& entry);
    void rehash();

    std::deque<Entry> entries_;
    std::vector<Slot> slots_;  ///< a power of two, at least twice as many as there are entries
    Entry* last_ = nullptr;    ///< placed
    std::size_t bytes_ = 0;
    std::uint64_t clock_ = 0;  ///< counts what is drawn
};

}  // namespace vtm::openvg

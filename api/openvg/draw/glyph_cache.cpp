#include "api/openvg/draw/glyph_cache.hpp"

#include <cmath>

namespace vtm::openvg {

namespace {

/// Of what is kept: about 5000 glyphs of 14 pixels.
constexpr std::size_t maxBytes = 8 << 20;
/// Of a glyph, in pixels: larger ones cost more to draw than to scan.
constexpr int maxGlyphSide = 64;
constexpr int phaseBits = 10, phases = 1 << phaseBits;
/// Beyond, floats have no 1024ths.
constexpr float maxPlace = 1 << 13;
/// From where the matrix puts the path's origin.
constexpr int farthest = 1 << 15;
constexpr Rectangle everywhere{-farthest, -farthest, farthest, farthest};

/// What an entry takes besides its runs.
constexpr std::size_t entryBytes = 256;

}  // namespace

glm::mat3 GlyphCache::Key::toPixel() const {
    return {
        matrix[0], matrix[1], 0, matrix[2], matrix[3], 0, float(phase[0]) / phases, float(phase[1]) / phases,
        1};
}

GlyphCache::Coverage GlyphCache::scanned(PathMask& mask, const glm::mat3& toPixel, const Rectangle& box) {
    Coverage coverage;
    mask.scan(toPixel, box, [&](int y, std::span<const CoverageRun> runs) {
        coverage.rows.push_back({y, coverage.runs.size()});
        coverage.runs.insert(coverage.runs.end(), runs.begin(), runs.end());
    });
    return coverage;
}

const GlyphCache::Coverage& GlyphCache::add(const Key& key, Coverage coverage) {
    const std::size_t bytes = coverage.bytes() + entryBytes;
    Entries added;  // of its own until nothing can fail any more
    added.push_front({{}, std::move(coverage)});
    added.front().place = found_.emplace(key, added.begin()).first;
    entries_.splice(entries_.begin(), added);
    bytes_ += bytes;
    while (bytes_ > maxBytes && entries_.size() > 1) {
        bytes_ -= entries_.back().coverage.bytes() + entryBytes;
        found_.erase(entries_.back().place);
        entries_.pop_back();
    }
    return entries_.front().coverage;
}

void GlyphCache::scan(PathMask& mask, const glm::mat3& toSurface, const Rectangle& clip, const RowSink& row) {
    const glm::vec3 place = toSurface[2];
    if (!(std::abs(place.x) < maxPlace && std::abs(place.y) < maxPlace))
        return mask.scan(toSurface, clip, row);
    const int x = int(std::lround(place.x * phases)), y = int(std::lround(place.y * phases));
    const Key key{mask.id(),
                  {toSurface[0].x, toSurface[0].y, toSurface[1].x, toSurface[1].y},
                  {x & (phases - 1), y & (phases - 1)}};
    const auto it = found_.find(key);
    if (it != found_.end()) {
        entries_.splice(entries_.begin(), entries_, it->second);
        return play(it->second->coverage, x >> phaseBits, y >> phaseBits, clip, row);
    }
    if (mask.bounds(toSurface, clip).empty())
        return;
    const Rectangle box = mask.bounds(key.toPixel(), everywhere);
    if (box.x1 - box.x0 > maxGlyphSide || box.y1 - box.y0 > maxGlyphSide)
        return mask.scan(toSurface, clip, row);
    play(add(key, scanned(mask, key.toPixel(), box)), x >> phaseBits, y >> phaseBits, clip, row);
}

void GlyphCache::play(const Coverage& coverage, int left, int bottom, const Rectangle& clip,
                      const RowSink& row) {
    for (std::size_t i = 0; i < coverage.rows.size(); ++i) {
        const std::size_t first = coverage.rows[i].first, end = i + 1 < coverage.rows.size()
                                                                    ? coverage.rows[i + 1].first
                                                                    : coverage.runs.size();
        const int at = coverage.rows[i].y + bottom;
        if (at < clip.y0 || at >= clip.y1)
            continue;
        moved_.clear();
        for (std::size_t k = first; k < end; ++k) {
            const CoverageRun& run = coverage.runs[k];
            const int from = std::max(run.first + left, clip.x0), to = std::min(run.end + left, clip.x1);
            if (from < to)
                moved_.push_back({from, to, run.share});
        }
        if (!moved_.empty())
            row(at, moved_);
    }
}

}  // namespace vtm::openvg

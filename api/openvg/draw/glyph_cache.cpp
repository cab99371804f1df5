#include "api/openvg/draw/glyph_cache.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <iterator>

namespace vtm::openvg {

namespace {

/// Of what is kept: about 13 000 glyphs of 14 pixels.
constexpr std::size_t maxBytes = 16 << 20;
constexpr int phaseBits = 10, phases = 1 << phaseBits;
/// Beyond, floats have no 1024ths.
constexpr float maxPlace = 1 << 13;
/// From where the matrix puts the path's origin.
constexpr int farthest = 1 << 15;
constexpr Rectangle everywhere{-farthest, -farthest, farthest, farthest};

/// To the nearest 1024th.
int inPhases(float place) {
    constexpr int positive = 1 << 24;  // numbers above 0 are truncated as one rounds down
    return int(double(place) * phases + positive + 0.5) - positive;
}

/// What an entry takes besides its coverage.
constexpr std::size_t entryBytes = 256;

}  // namespace

// ---- One glyph ------------------------------------------------------------------------------------

GlyphCoverage::GlyphCoverage(PathMask& mask, const glm::mat3& toPixel, const Rectangle& box) : box_(box) {
    mask.scan(toPixel, box, [&](int row, std::span<const CoverageRun> runs) {
        const auto y = std::uint8_t(row - box.y0);
        for (const CoverageRun& run : runs) {
            const unsigned share = fixedShare(run.share);
            const auto first = std::uint8_t(run.first - box.x0), end = std::uint8_t(run.end - box.x0);
            if (share >= FlatGround::whole)  // so that it means the same there as here
                runs_.push_back({first, end, y});
            else if (share > 0)
                for (std::uint8_t x = first; x < end; ++x)
                    edges_.push_back({x, y, std::uint16_t(share)});
        }
    });
    edges_.shrink_to_fit();
    runs_.shrink_to_fit();
    forEachRow([&](int, std::span<const std::uint16_t> shares) {
        FlatGround::forEachGroup(shares, [&](std::size_t) { ++groupCount_; });
    });
}

std::size_t GlyphCoverage::bytes() const {
    return sizeof(EdgePixel) * edges_.size() + sizeof(Run) * runs_.size() +
           FlatGround::groupBytes * groupCount_;
}

void GlyphCoverage::play(int left, int bottom, const Rectangle& clip, const RowSink& row) const {
    left += box_.x0;
    bottom += box_.y0;
    std::vector<CoverageRun> played;
    const auto add = [&](int first, int end, float share) {
        first = std::max(first + left, clip.x0);
        end = std::min(end + left, clip.x1);
        if (first < end)
            played.push_back({first, end, share});
    };
    auto edge = edges_.begin();
    auto run = runs_.begin();
    for (int y = std::max(0, clip.y0 - bottom); y < std::min(box_.y1 - box_.y0, clip.y1 - bottom); ++y) {
        played.clear();
        while (edge != edges_.end() && edge->y < y)
            ++edge;
        while (run != runs_.end() && run->y < y)
            ++run;
        while (true) {
            const bool hasEdge = edge != edges_.end() && edge->y == y,
                       hasRun = run != runs_.end() && run->y == y;
            if (hasEdge && (!hasRun || edge->x < run->first)) {
                add(edge->x, edge->x + 1, float(edge->share) / wholeShare);
                ++edge;
            } else if (hasRun) {
                add(run->first, run->end, 1);
                ++run;
            } else {
                break;
            }
        }
        if (!played.empty())
            row(bottom + y, played);
    }
}

// ---- All of them ----------------------------------------------------------------------------------

std::uint64_t GlyphCache::hash(const Key& key) {
    // Rounds of multiplication, of which the high half returns to the low one.
    constexpr std::uint64_t odd = 0x9E37'79B9'7F4A'7C15;
    const auto mixed = [](std::uint64_t h) { return (h ^ h >> 32) * odd; };
    std::uint64_t h = mixed(key.mask << 20 ^ key.phase);
    h = mixed(h ^ key.columns[0]);
    h = mixed(h ^ key.columns[1]);
    return h ^ h >> 32;
}

GlyphCache::Entry* GlyphCache::find(const Key& key, std::uint64_t hash) const {
    if (slots_.empty())
        return nullptr;
    for (std::size_t i = hash;; ++i) {
        const Slot& slot = slots_[i & (slots_.size() - 1)];
        if (!slot.entry || (slot.hash == hash && slot.entry->key == key))
            return slot.entry;
    }
}

PlacedGlyph GlyphCache::use(Entry& entry, int left, int bottom) {
    entry.used = ++clock_;
    if (last_)
        last_->next = &entry;
    last_ = &entry;
    return {&entry.coverage, left, bottom};
}

void GlyphCache::insert(std::uint64_t hash, Entry& entry) {
    std::size_t i = hash;
    while (slots_[i & (slots_.size() - 1)].entry)
        ++i;
    slots_[i & (slots_.size() - 1)] = {hash, &entry};
}

void GlyphCache::rehash() {
    slots_.assign(std::bit_ceil(4 * entries_.size()), {});
    for (Entry& entry : entries_)
        insert(hash(entry.key), entry);
}

bool GlyphCache::place(PathMask& mask, const glm::mat3& toSurface, const Rectangle& clip,
                       std::vector<PlacedGlyph>& placed) {
    const glm::vec3 place = toSurface[2];
    if (!(std::abs(place.x) < maxPlace && std::abs(place.y) < maxPlace))
        return false;
    const int x = inPhases(place.x), y = inPhases(place.y);
    const auto phase = [](int v) { return std::uint32_t(v & (phases - 1)); };
    const auto bits = [&](int column) {
        return std::bit_cast<std::uint64_t>(std::array{toSurface[column].x, toSurface[column].y});
    };
    const Key key{mask.id(), {bits(0), bits(1)}, phase(x) << phaseBits | phase(y)};
    const int left = x >> phaseBits, bottom = y >> phaseBits;
    if (last_ && last_->next && last_->next->key == key) {
        placed.push_back(use(*last_->next, left, bottom));
        return true;
    }
    const std::uint64_t hashed = hash(key);
    if (Entry* const found = find(key, hashed)) {
        placed.push_back(use(*found, left, bottom));
        return true;
    }
    if (mask.bounds(toSurface, clip).empty())
        return true;
    glm::mat3 toPixel = toSurface;
    toPixel[2] = {float(phase(x)) / phases, float(phase(y)) / phases, 1};
    const Rectangle box = mask.bounds(toPixel, everywhere);
    if (box.x1 - box.x0 > GlyphCoverage::maxSide || box.y1 - box.y0 > GlyphCoverage::maxSide)
        return false;
    Entry& entry = entries_.emplace_back(Entry{key, {mask, toPixel, box}, 0});
    bytes_ += entry.coverage.bytes() + entryBytes;
    if (slots_.size() < 2 * entries_.size())
        rehash();
    else
        insert(hashed, entry);
    placed.push_back(use(entry, left, bottom));
    return true;
}

void GlyphCache::trim() {
    if (bytes_ <= maxBytes)
        return;
    std::vector<Entry> all(std::make_move_iterator(entries_.begin()),
                           std::make_move_iterator(entries_.end()));
    std::ranges::sort(all, std::greater(), &Entry::used);
    entries_.clear();
    last_ = nullptr;
    bytes_ = 0;
    // More goes than must: this takes a while.
    constexpr std::size_t left = maxBytes / 4 * 3;
    for (Entry& entry : all) {
        bytes_ += entry.coverage.bytes() + entryBytes;
        if (bytes_ > left)
            break;
        entries_.push_back(std::move(entry));
        entries_.back().next = nullptr;
    }
    rehash();
}

}  // namespace vtm::openvg

#include "raster/src/pixel_memory.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <mutex>
#include <new>
#include <unordered_map>

#include <vtm/limits/limits.hpp>

namespace vtm::asset {

namespace {

constexpr std::size_t hugePage = 2 << 20, page = 4 << 10;  ///< bytes
/// A free block is lent for less than itself, but not for less than this share of it.
constexpr std::size_t leastShare = 2;
/// Free blocks are kept up to so many bytes: while something is drawn, a dozen pictures of 2048² pixels;
/// between drawings, what a hundred filters took at 1024² pixels (128 MB were too few for that).
constexpr std::size_t mostWhileDrawing = std::size_t(1) << 30, mostBetween = 192 << 20;

/// To quarters of powers of two, so that blocks of nearly one size fit for each other. The system gives
/// memory only to the part of a block that is used.
std::size_t roundedUp(std::size_t bytes) {
    const std::size_t step = std::max(std::bit_floor(bytes) / 4, bytes < hugePage ? page : hugePage);
    return (bytes + step - 1) / step * step;
}

/// From the system, not from glibc's heap: that seldom finds room for such an alignment where such a block
/// was freed, so it grows with each drawing.
void* newHugePages(std::size_t bytes) {
    void* const all =
        mmap(nullptr, bytes + hugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED)
        throw std::bad_alloc();
    auto* const first = static_cast<std::uint8_t*>(all);
    const std::size_t before = (hugePage - reinterpret_cast<std::uintptr_t>(all) % hugePage) % hugePage;
    if (before > 0)
        munmap(first, before);
    munmap(first + before + bytes, hugePage - before);
    madvise(first + before, bytes, MADV_HUGEPAGE);  // fails where there are none, which changes nothing
    return first + before;
}

void* newBlock(std::size_t bytes) {
    limits::need(bytes);
    if (bytes >= hugePage)
        return newHugePages(bytes);
    void* const block = std::malloc(bytes);
    if (!block)
        throw std::bad_alloc();
    return block;
}

void freeBlock(void* block, std::size_t size) noexcept {
    if (size >= hugePage)
        munmap(block, size);
    else
        std::free(block);
}

/// Those of the process that are free.
class FreeBlocks {
public:
    static FreeBlocks& ofProcess() {
        static FreeBlocks& all = *new FreeBlocks;  // as long as the process: globals may have pixels
        return all;
    }

    /// Null if none fits.
    void* take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        const auto found = free_.lower_bound(bytes);
        if (found == free_.end() || found->first > leastShare * bytes)
            return nullptr;
        const auto [size, block] = *found;
        if (size != bytes)
            lent_[block] = size;
        bytes_ -= size;
        free_.erase(found);
        return block;
    }
    void give(void* block, std::size_t bytes) noexcept {
        const std::lock_guard lock(mutex_);
        std::size_t size = bytes;
        if (const auto lent = lent_.find(block); lent != lent_.end()) {
            size = lent->second;
            lent_.erase(lent);
        }
        if (!keep(block, size))
            freeBlock(block, size);
    }
    void beginDrawing() {
        const std::lock_guard lock(mutex_);
        ++drawings_;
    }
    void endDrawing() noexcept {
        const std::lock_guard lock(mutex_);
        --drawings_;
        while (bytes_ > most()) {
            const auto largest = std::prev(free_.end());
            bytes_ -= largest->first;
            freeBlock(largest->second, largest->first);
            free_.erase(largest);
        }
    }

private:
    std::size_t most() const { return drawings_ > 0 ? mostWhileDrawing : mostBetween; }
    bool keep(void* block, std::size_t size) noexcept {
        if (bytes_ + size > most())
            return false;
        try {
            free_.emplace(size, block);
        } catch (const std::bad_alloc&) {
            return false;
        }
        bytes_ += size;
        return true;
    }

    std::mutex mutex_;                             ///< guards what follows
    std::multimap<std::size_t, void*> free_;       ///< by their size
    std::unordered_map<void*, std::size_t> lent_;  ///< of those lent for less, their size
    std::size_t bytes_ = 0;                        ///< of free_
    std::size_t drawings_ = 0;                     ///< that last
};

}  // namespace

BlocksOfDrawing::BlocksOfDrawing() { FreeBlocks::ofProcess().beginDrawing(); }
BlocksOfDrawing::~BlocksOfDrawing() { FreeBlocks::ofProcess().endDrawing(); }

void* takeBlock(std::size_t bytes) {
    bytes = roundedUp(bytes);
    void* const kept = FreeBlocks::ofProcess().take(bytes);
    return kept ? kept : newBlock(bytes);
}

void giveBlock(void* block, std::size_t bytes) noexcept {
    FreeBlocks::ofProcess().give(block, roundedUp(bytes));
}

}  // namespace vtm::asset

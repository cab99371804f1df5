#include "raster/src/pixel_memory.hpp"

#include <sys/mman.h>

#include <cstdlib>

#include <vtm/limits/limits.hpp>

namespace vtm::asset {

namespace {

constexpr std::size_t hugePage = 2 << 20, page = 4 << 10;  ///< bytes
/// A free block is lent for less than itself, but not for less than this share of it.
constexpr std::size_t leastShare = 2;
/// Free blocks are kept up to so many bytes: a dozen pictures of 2048² pixels.
constexpr std::size_t mostKept = std::size_t(1) << 30;

thread_local KeptBlocks* current = nullptr;

std::size_t roundedUp(std::size_t bytes) {
    const std::size_t step = bytes < hugePage ? page : hugePage;
    return (bytes + step - 1) / step * step;
}

void* newBlock(std::size_t bytes) {
    limits::need(bytes);
    void* const block = std::aligned_alloc(bytes < hugePage ? page : hugePage, bytes);
    if (!block)
        throw std::bad_alloc();
    if (bytes >= hugePage)
        madvise(block, bytes, MADV_HUGEPAGE);  // fails where there are none, which changes nothing
    return block;
}

}  // namespace

KeptBlocks::KeptBlocks() : outer_(std::exchange(current, this)) {}

KeptBlocks::~KeptBlocks() {
    current = outer_;
    for (const auto& [bytes, block] : free_)
        std::free(block);
}

KeptBlocks* KeptBlocks::ofThread() { return current; }

KeptBlocks::Shared::Shared(KeptBlocks* blocks) : before_(std::exchange(current, blocks ? blocks : current)) {}
KeptBlocks::Shared::~Shared() { current = before_; }

void* KeptBlocks::take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const auto found = free_.lower_bound(bytes);
    if (found == free_.end() || found->first > leastShare * bytes)
        return nullptr;
    const auto [size, block] = *found;
    if (size != bytes)
        largest_[block] = size;
    bytes_ -= size;
    free_.erase(found);
    return block;
}

/// One that was there and was not given back here.
void KeptBlocks::forget(void* block) {
    const std::lock_guard lock(mutex_);
    largest_.erase(block);
}

bool KeptBlocks::keep(void* block, std::size_t bytes) noexcept {
    const std::lock_guard lock(mutex_);
    const auto lent = largest_.find(block);
    const std::size_t size = lent == largest_.end() ? bytes : lent->second;
    if (lent != largest_.end())
        largest_.erase(lent);
    if (bytes_ + size > mostKept)
        return false;
    try {
        free_.emplace(size, block);
    } catch (const std::bad_alloc&) {
        return false;
    }
    bytes_ += size;
    return true;
}

void* takeBlock(std::size_t bytes) {
    bytes = roundedUp(bytes);
    if (!current)
        return newBlock(bytes);
    if (void* const kept = current->take(bytes))
        return kept;
    void* const block = newBlock(bytes);
    current->forget(block);
    return block;
}

void giveBlock(void* block, std::size_t bytes) noexcept {
    if (!current || !current->keep(block, roundedUp(bytes)))
        std::free(block);
}

}  // namespace vtm::asset

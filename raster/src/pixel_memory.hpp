/// \file
/// Memory of pixels that are written before they are read: a large raster is not filled with zeros first.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include "raster/src/float4.hpp"

namespace vtm::asset {

/// While it lives, large blocks of pixels that its threads free are used again: filters make and drop a dozen
/// rasters of one size, and a new one's pages, which the system clears one by one, cost more than filling it.
class KeptBlocks {
public:
    /// For the thread that makes it.
    KeptBlocks();
    ~KeptBlocks();
    KeptBlocks(const KeptBlocks&) = delete;
    KeptBlocks& operator=(const KeptBlocks&) = delete;

    /// Those of this thread; null if there are none.
    static KeptBlocks* ofThread();
    /// Lets another thread use them, or does nothing for null.
    class Shared {
    public:
        explicit Shared(KeptBlocks* blocks);
        ~Shared();
        Shared(const Shared&) = delete;
        Shared& operator=(const Shared&) = delete;

    private:
        KeptBlocks* const before_;
    };

private:
    friend void* takeBlock(std::size_t bytes);
    friend void giveBlock(void* block, std::size_t bytes) noexcept;

    void* take(std::size_t bytes);
    void forget(void* block);
    bool keep(void* block, std::size_t bytes) noexcept;

    KeptBlocks* const outer_;
    std::mutex mutex_;                                ///< guards what follows
    std::multimap<std::size_t, void*> free_;          ///< by their size
    std::unordered_map<void*, std::size_t> largest_;  ///< of those lent for less, their size
    std::size_t bytes_ = 0;                           ///< of free_
};

/// At least so many bytes, aligned for any pixel. Blocks of 2 MB and more are in huge pages where Linux has
/// them. Throws std::bad_alloc, or what limits::need throws.
void* takeBlock(std::size_t bytes);
/// `bytes`: as it was taken for.
void giveBlock(void* block, std::size_t bytes) noexcept;

/// Elements that are given no value stay as the memory was.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };

    static constexpr std::size_t largeBlock = 64 << 10;  ///< bytes

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        return bytes < largeBlock ? std::allocator<T>::allocate(count) : static_cast<T*>(takeBlock(bytes));
    }
    void deallocate(T* memory, std::size_t count) {
        if (const std::size_t bytes = count * sizeof(T); bytes < largeBlock)
            std::allocator<T>::deallocate(memory, count);
        else
            giveBlock(memory, bytes);
    }

    template <class U>
    void construct(U* at) {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Values>
    void construct(U* at, Values&&... values) {
        ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
    }
};

using PixelMemory = std::vector<Float4, UninitialisedAllocator<Float4>>;

}  // namespace vtm::asset

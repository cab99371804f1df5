/// \file
/// Memory of pixels that are written before they are read: a large raster is not filled with zeros first.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Large blocks of pixels that are freed are used again: filters make and drop a dozen rasters of one size,
/// and a new one's pages, which the system clears one by one, cost more than filling it. While one of these
/// lives, in whatever thread, up to 1 GB is kept for the process, and between drawings up to 192 MB, since
/// the next one needs the same.
class BlocksOfDrawing {
public:
    BlocksOfDrawing();
    ~BlocksOfDrawing();
    BlocksOfDrawing(const BlocksOfDrawing&) = delete;
    BlocksOfDrawing& operator=(const BlocksOfDrawing&) = delete;
};

/// At least so many bytes, aligned as malloc does. Blocks of 2 MB and more are the system's own, in huge
/// pages where Linux has them, and go back to it. Throws std::bad_alloc, or what limits::need throws.
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

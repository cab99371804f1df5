/// \file
/// Memory of pixels that are written before they are read: a large raster is not filled with zeros first.
#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <vtm/limits/limits.hpp>
#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Elements that are given no value stay as the memory was. Large blocks are in huge pages where Linux has
/// them: a raster's first use of its 4 KB pages, one after the other, took longer than filling it.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };

    static constexpr std::size_t hugePage = 2 << 20;  ///< bytes

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < hugePage)
            return std::allocator<T>::allocate(count);
        limits::need(bytes);
        void* const memory = std::aligned_alloc(hugePage, (bytes + hugePage - 1) / hugePage * hugePage);
        if (!memory)
            throw std::bad_alloc();
        madvise(memory, bytes, MADV_HUGEPAGE);  // fails where there are none, which changes nothing
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < hugePage)
            std::allocator<T>::deallocate(memory, count);
        else
            std::free(memory);
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

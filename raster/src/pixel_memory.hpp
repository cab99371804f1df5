/// \file
/// Memory of pixels that are written before they are read: a large raster is not filled with zeros first.
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "raster/src/float4.hpp"

namespace vtm::asset {

/// Elements that are given no value stay as the memory was.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };
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

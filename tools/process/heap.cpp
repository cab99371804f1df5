#include "tools/process/heap.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace vtm::tools {

namespace {

/// Rasters come and go by the dozen. Memory that is given back to the system comes again page by page, which
/// took a sixth of the time of pictures with filters.
void keepFreedMemory() {
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // bytes; the most that it takes
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

/// The heap gets addresses, which become memory when they are used: in huge pages, where the system has them.
/// A small page is a fault when it is first used. That takes 0.2 µs, on virtual machines more than 10, where
/// the faults of a map took a third of the time of drawing it.
void growByHugePages() {
    constexpr int addresses = 128 << 20, usualPad = 128 << 10;
    constexpr std::size_t more = 1 << 20;  // than the heap has when a process starts
    const auto end = [] { return reinterpret_cast<std::uintptr_t>(sbrk(0)); };
    const auto pageBytes = std::uintptr_t(sysconf(_SC_PAGESIZE));
    const std::uintptr_t first = (end() + pageBytes - 1) / pageBytes * pageBytes;
    mallopt(M_TOP_PAD, addresses);
    void* volatile const growing = std::malloc(more);  // volatile: else it is left out
    std::free(growing);
    mallopt(M_TOP_PAD, usualPad);
    if (end() > first)
        madvise(reinterpret_cast<void*>(first), end() - first, MADV_HUGEPAGE);  // a wish, no more
}

}  // namespace

void prepareHeap() {
    keepFreedMemory();
    growByHugePages();
}

void trimHeap() {
    malloc_trim(0);
    growByHugePages();
}

}  // namespace vtm::tools

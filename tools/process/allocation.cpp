// Large allocations of the command ask its limits first, whoever makes them: what grows by doubling would
// pass
// --max-memory by far between two looks at the clock. Sanitizers bring allocators of their own.
#include <cstdlib>
#include <exception>
#include <new>

#include <vtm/limits/limits.hpp>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

void* operator new(std::size_t size) {
    if (std::uncaught_exceptions() == 0)  // what is being given up may finish
        vtm::limits::need(size);
    if (void* memory = std::malloc(size > 0 ? size : 1))
        return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif

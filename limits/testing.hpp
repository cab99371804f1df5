/// \file
/// For tests of recursions.
#pragma once

#include <cstddef>
#include <system_error>

#include <pthread.h>

namespace vtm::limits::testing {

/// Calls `function`, which must not throw, on a thread with a stack of 1 MB, as small as those of some
/// systems' workers.
template <class Function>
void onSmallStack(Function function) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, std::size_t{1} << 20);
    pthread_t thread{};
    const auto run = [](void* of) -> void* {
        (*static_cast<Function*>(of))();
        return nullptr;
    };
    const int error = pthread_create(&thread, &attributes, run, &function);
    pthread_attr_destroy(&attributes);
    if (error != 0)
        throw std::system_error(error, std::generic_category());
    pthread_join(thread, nullptr);
}

}  // namespace vtm::limits::testing


#include <tbb/global_control.h>

#include <vtm/limits/limits.hpp>

#include "tests/fuzz/pipeline_run.hpp"

/// Of one run, with the sanitizers: work beyond it is refused, as users of limits have it.
constexpr double seconds = 4;

/// One thread: what a run does is then the same each time, and small pictures are done sooner.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vtm::limits::Budget budget({.seconds = seconds});
    const vtm::limits::Scope scope(budget);
    try {
        vtm::fuzz::runPipeline({data, size});
    } catch (const vtm::limits::Exceeded&) {
    }
    return 0;
}

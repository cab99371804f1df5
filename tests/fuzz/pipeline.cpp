
#include <tbb/global_control.h>

#include "tests/fuzz/pipeline_run.hpp"

/// One thread: what a run does is then the same each time, and small pictures are done sooner.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vtm::fuzz::runPipeline({data, size});
    return 0;
}

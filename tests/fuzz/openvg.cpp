#include "tests/fuzz/openvg_calls.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vtm::fuzz::runOpenVgCalls({data, size});
    return 0;
}

#include <vtm/image/codec.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        vtm::image::decode({data, size});
    } catch (const vtm::image::CodecError&) {
    }
    return 0;
}

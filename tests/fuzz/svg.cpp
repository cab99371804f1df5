#include <vtm/svg/load.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        vtm::scene::validate(vtm::svg::load({data, size}).scene);
    } catch (const vtm::svg::ParseError&) {
    }
    return 0;
}

#include "asset/container.hpp"
#include "asset/evaluate.hpp"

namespace {

constexpr int side = 16;

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const vtm::asset::Asset asset = vtm::asset::read({data, size});
        vtm::asset::evaluate(asset, {side, side, {side / asset.width, 0, 0, side / asset.height, 0, 0}});
    } catch (const vtm::asset::FormatError&) {
    }
    return 0;
}

#include "asset/container.hpp"
#include "asset/evaluate.hpp"
#include "asset/testing_files.hpp"

namespace {

constexpr int side = 16;

}

/// The checksums are put right first: they would stop nearly every mutation at the door.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    vtm::asset::test::Bytes file(data, data + size);
    if (file.size() >= vtm::asset::test::headerBytes)
        vtm::asset::test::fixChecksums(file);
    try {
        const vtm::asset::Asset asset = vtm::asset::read(file);
        vtm::asset::evaluate(asset, {side, side, {side / asset.width, 0, 0, side / asset.height, 0, 0}});
    } catch (const vtm::asset::FormatError&) {
    }
    return 0;
}

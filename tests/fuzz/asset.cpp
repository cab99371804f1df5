#include <stdexcept>

#include <vtm/asset/container.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/paint_at.hpp>
#include <vtm/raster/prefilter.hpp>
#include <vtm/raster/scan.hpp>

#include "asset/testing_files.hpp"

namespace {

using namespace vtm::asset;

constexpr int side = 16;

/// Of one run, with the sanitizers: work beyond it is refused, as users of limits have it.
constexpr double seconds = 4;

void require(bool holds, const char* what) {
    if (!holds)
        throw std::logic_error(what);
}

void checkColors(const vtm::image::Raster& raster) {
    for (const float value : raster.rgba)
        require(value >= 0 && value <= 1, "a channel is not in [0, 1]");
}

/// Whatever a valid asset holds, engines make colours of it.
void use(const Asset& asset) {
    const View view{side, side, {side / asset.width, 0, 0, side / asset.height, 0, 0}};
    checkColors(evaluate(asset, view));
    if (isSumOfMaps(asset)) {
        checkColors(Scanner(asset).draw(view));
        require(
            paintAt(asset, {asset.width / 3, asset.height / 3}) < asset.paints.size() || asset.paints.empty(),
            "a paint that is not there");
    }
    summarize(asset);
}

}  // namespace

/// The checksums are put right first: they would stop nearly every mutation at the door.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    test::Bytes file(data, data + size);
    if (file.size() >= test::headerBytes)
        test::fixChecksums(file);
    Asset asset;
    try {
        asset = read(file);
    } catch (const FormatError&) {
        return 0;
    }
    const test::Bytes written = write(asset);
    require(write(read(written)) == written, "what was read is written as other bytes");
    vtm::limits::Budget budget({.seconds = seconds});
    const vtm::limits::Scope scope(budget);
    try {
        use(asset);
    } catch (const vtm::limits::Exceeded&) {
    }
    return 0;
}

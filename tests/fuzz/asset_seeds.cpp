// Writes the files that the fuzz target `asset` starts from into a folder: one of each kind of record.

#include <vtm/asset/container.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/raster/prefilter.hpp>
#include "asset/testing.hpp"

namespace {

using namespace vtm::asset;

Asset withPrefilter(Asset asset) {
    asset.prefilter = buildPrefilter(asset, PyramidSize{4, 4}, 1);
    return asset;
}

}  // namespace

int main(int, char** arguments) {
    const Asset assets[] = {test::emptyAsset(),
                            test::halfPlane(),
                            test::disc(),
                            test::twoLevels(),
                            test::everyPaint(),
                            test::blendAsset(Blend::Hue),
                            withPrefilter(test::wedge()),
                            test::placedMaps()};
    int number = 0;
    for (const Asset& asset : assets)
        vtm::image::writeFile(std::string(arguments[1]) + "/" + std::to_string(number++) + ".vtm",
                              write(asset));
}

#include "tools/engines/cpu_engine.hpp"

#include <stdexcept>

#include <vtm/limits/limits.hpp>
#include <vtm/raster/scan.hpp>
#include "raster/scan_rows.hpp"

namespace vtm::tools {

void CpuEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                     const image::RowSink& sink) {
    if (source.paper || !asset::isSumOfMaps(*source.asset))
        throw std::runtime_error("the cpu engine only draws exact mode");
    if (!source.asset->materials.empty())
        warnOfMaterials(source);
    const asset::Scanner scanner =
        timed(source.stages, "upload", [&] { return asset::Scanner(*source.asset); });
    double sinking = 0;  // is not drawing
    const double all = millisecondsOf([&] {
        asset::scanRows(scanner, view, writer, [&](std::span<const std::uint8_t> row) {
            sinking += millisecondsOf([&] { sink(row); });
        });
    });
    source.stages.emplace_back("render", all - sinking);
}

}  // namespace vtm::tools

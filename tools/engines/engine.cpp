#include "tools/engines/engine.hpp"

#include <optional>
#include <stdexcept>

#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/scan.hpp>
#include "conformance/reference/reference.hpp"
#include "paper/evaluate.hpp"
#include "tools/engines/automatic_engine.hpp"
#include "tools/engines/cpu_engine.hpp"
#include "tools/engines/gl_engine.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

namespace {

class AssetEngine : public RasterEngine {
public:
    std::string name() const override { return "asset"; }

protected:
    image::Raster render(Source& source, const asset::View& view) override {
        if (!source.paper && !source.asset->materials.empty())
            warnOfMaterials(source);
        return timed(source.stages, "render", [&] {
            return source.paper ? paper::evaluate(source.paper->asset, view, &source.cost.emplace())
                                : asset::evaluate(*source.asset, view);
        });
    }
};

class ReferenceEngine : public RasterEngine {
public:
    explicit ReferenceEngine(asset::Mode mode) {
        options_.mode = mode == asset::Mode::Exact ? reference::Mode::Exact : reference::Mode::Compat;
    }
    std::string name() const override { return "reference"; }
    bool needsAsset() const override { return false; }

protected:
    image::Raster render(Source& source, const asset::View& view) override {
        if (!source.scene)
            throw std::runtime_error("the reference engine only draws SVG files, not .vtm files");
        const reference::View same{view.width, view.height, view.toPixels};
        return timed(source.stages, "render",
                     [&] { return reference::render(*source.scene, same, options_); });
    }

private:
    reference::Options options_;
};

}  // namespace

void warnOfMaterials(Source& source) {
    warnOf(source, source.name + ": warning: no GLSL runs on the CPU; materials have their fallback colours");
}

image::Bitmap drawBitmap(Engine& engine, Source& source, const asset::View& view,
                         const image::PixelWriter& writer) {
    image::Bitmap bitmap{view.width, view.height, {}};
    bitmap.rgba.reserve(std::size_t(view.width) * std::size_t(view.height) * 4);
    engine.draw(source, view, writer, [&](std::span<const std::uint8_t> row) {
        bitmap.rgba.insert(bitmap.rgba.end(), row.begin(), row.end());
    });
    return bitmap;
}

void RasterEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                        const image::RowSink& sink) {
    image::giveRows(render(source, view), writer, sink);
}

std::unique_ptr<Engine> makeEngine(const std::string& name, asset::Mode mode,
                                   const std::string& programCache) {
    if (name == "gl")
        return std::make_unique<GlEngine>(programCache);
    if (name == "auto")
        return std::make_unique<AutomaticEngine>(mode, programCache);
    if (name == "cpu")
        return std::make_unique<CpuEngine>();
    if (name == "asset")
        return std::make_unique<AssetEngine>();
    if (name == "reference")
        return std::make_unique<ReferenceEngine>(mode);
    throw UsageError("--engine: '" + name + "' is not one of auto, gl, cpu, asset, reference");
}

}  // namespace vtm::tools

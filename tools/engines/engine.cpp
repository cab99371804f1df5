#include "tools/engines/engine.hpp"

#include <optional>
#include <stdexcept>

#include <vtm/gl/renderer.hpp>
#include <vtm/limits/limits.hpp>
#include <vtm/raster/evaluate.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "compiler/draw_rows.hpp"
#include "conformance/reference/reference.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/renderer.hpp"
#include "raster/scan_rows.hpp"
#include "tools/process/errors.hpp"
#include "tools/process/messages.hpp"

namespace vtm::tools {

namespace {

class GlEngine : public RasterEngine {
public:
    explicit GlEngine(const std::string& programCache) { options_.programCache = programCache; }
    std::string name() const override { return "gl"; }
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;

    /// Makes the context and the renderers, once. Throws gl::GlError.
    void start(Stages& stages);
    /// After start(): whether the shaders run on the CPU.
    bool isSoftware() const { return gl_->context.isSoftware(); }

protected:
    /// Paper mode, and more than 8 bits.
    image::Raster render(Source& source, const asset::View& view) override;

private:
    /// The context comes first: the programs need it for their whole life.
    struct Gl {
        explicit Gl(const gl::RendererOptions& options) : renderer(options) {}

        gl::Context context;
        gl::Renderer renderer;
        paper::Renderer paper;
    };
    gl::RendererOptions options_;
    std::unique_ptr<Gl> gl_;
};

void GlEngine::start(Stages& stages) {
    if (!gl_)
        gl_ = timed(stages, "start", [&] { return std::make_unique<Gl>(options_); });
}

void GlEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                    const image::RowSink& sink) {
    start(source.stages);
    if (source.paper || writer.depth() > 8)
        return RasterEngine::draw(source, view, writer, sink);
    const gl::Texture texture =
        timed(source.stages, "upload", [&] { return gl_->renderer.upload(*source.asset); });
    const image::Bitmap bitmap =
        timed(source.stages, "render", [&] { return gl_->renderer.renderBitmap(texture, view); });
    image::giveRows(bitmap, writer, sink);
}

image::Raster GlEngine::render(Source& source, const asset::View& view) {
    if (source.paper) {
        const paper::Texture texture =
            timed(source.stages, "upload", [&] { return paper::Texture(source.paper->asset); });
        return timed(source.stages, "render", [&] { return gl_->paper.render(texture, view); });
    }
    const gl::Texture texture =
        timed(source.stages, "upload", [&] { return gl_->renderer.upload(*source.asset); });
    return timed(source.stages, "render", [&] { return gl_->renderer.render(texture, view); });
}

/// Holds a row of pixels, not the picture.
class CpuEngine : public Engine {
public:
    std::string name() const override { return "cpu"; }
    bool drawsOnce(Source&) override { return true; }
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;
};

void CpuEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                     const image::RowSink& sink) {
    if (source.paper || (source.asset && source.asset->mode != asset::Mode::Exact))
        throw std::runtime_error("the cpu engine only draws exact mode");
    if (source.asset && !source.asset->materials.empty())
        warnOfMaterials(source);
    std::optional<asset::Scanner> scanner;
    if (source.asset && asset::isSumOfMaps(*source.asset))
        timed(source.stages, "upload", [&] { return &scanner.emplace(*source.asset); });
    double sinking = 0;  // is not drawing
    const image::RowSink timedSink = [&](std::span<const std::uint8_t> row) {
        sinking += millisecondsOf([&] { sink(row); });
    };
    const double all = millisecondsOf([&] {
        if (source.drawing)
            compiler::drawRows(*source.drawing, writer, timedSink);
        else if (scanner)
            asset::scanRows(*scanner, view, writer, timedSink);
        else
            asset::scanRows(asset::Evaluator(*source.asset), view, writer, timedSink);
    });
    source.stages.emplace_back("render", all - sinking);
}

/// The shaders where there is a GPU. Else the scanner for all that it can draw (exact pictures without
/// materials), and for the rest the shaders on the CPU, or where there is no EGL their twin.
///
/// Whether there is a GPU is asked once, at the first picture, and a context is made only if one may be there
/// or shaders are needed.
class AutomaticEngine : public Engine {
public:
    AutomaticEngine(asset::Mode mode, const std::string& programCache);
    std::string name() const override { return drawing_->name(); }
    bool drawsOnce(Source& source) override {
        return driver(source) == gl::Driver::None || driver(source) == gl::Driver::Software;
    }
    void draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
              const image::RowSink& sink) override;

private:
    Engine& engineFor(Source& source);
    /// Looks for EGL's devices at the first call.
    gl::Driver driver(Source& source);
    /// Whether there is a context, which is made; says so where there is none.
    bool startsGl(Source& source);
    void doWithoutGl(const std::string& why);

    std::optional<gl::Driver> driver_;
    GlEngine gl_;
    std::unique_ptr<Engine> scanner_, twin_;
    Engine* drawing_;
};

/// Exact pictures without materials.
bool scannerDraws(const Source& source) {
    return source.drawing ||
           (source.asset && source.asset->mode == asset::Mode::Exact && source.asset->materials.empty());
}

AutomaticEngine::AutomaticEngine(asset::Mode mode, const std::string& programCache)
    : gl_(programCache),
      scanner_(makeEngine("cpu", mode)),
      twin_(makeEngine("asset", mode)),
      drawing_(scanner_.get()) {}

void AutomaticEngine::draw(Source& source, const asset::View& view, const image::PixelWriter& writer,
                           const image::RowSink& sink) {
    drawing_ = &engineFor(source);
    drawing_->draw(source, view, writer, sink);
}

Engine& AutomaticEngine::engineFor(Source& source) {
    const bool scans = scannerDraws(source);
    Engine& onCpu = scans ? *scanner_ : *twin_;
    if (source.asset && !source.asset->filters.empty())
        return onCpu;
    if (driver(source) == gl::Driver::None || (scans && driver(source) == gl::Driver::Software))
        return onCpu;
    if (!startsGl(source))
        return onCpu;
    return scans && gl_.isSoftware() ? onCpu : gl_;
}

gl::Driver AutomaticEngine::driver(Source& source) {
    if (!driver_) {
        driver_ = timed(source.stages, "start", [] { return gl::likelyDriver(); });
        if (driver_ == gl::Driver::None)
            doWithoutGl("EGL has no driver");
    }
    return *driver_;
}

bool AutomaticEngine::startsGl(Source& source) {
    try {
        gl_.start(source.stages);
        return true;
    } catch (const gl::GlError& error) {
        doWithoutGl(error.what());
        return false;
    }
}

void AutomaticEngine::doWithoutGl(const std::string& why) {
    driver_ = gl::Driver::None;
    warn("vtm: " + why + "; drawing on the CPU");
}

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

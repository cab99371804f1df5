#include "tools/src/engine.hpp"

#include <optional>
#include <stdexcept>

#include "asset/evaluate.hpp"
#include "asset/scan.hpp"
#include "backend_gl/paper.hpp"
#include "backend_gl/renderer.hpp"
#include "conformance/reference/reference.hpp"
#include "tools/src/color.hpp"
#include "tools/src/commands.hpp"
#include "tools/src/report.hpp"

namespace vtm::tools {

namespace {

class GlEngine : public Engine {
public:
    explicit GlEngine(const std::string& programCache) { options_.programCache = programCache; }
    image::Bitmap draw(Source& source, const asset::View& view, const scene::Color& ground) override {
        if (!gl_)
            gl_ = timed(source.stages, "start", [&] { return std::make_unique<Gl>(options_); });
        if (source.paper)
            return Engine::draw(source, view, ground);
        const gl::Texture texture =
            timed(source.stages, "upload", [&] { return gl_->renderer.upload(*source.asset); });
        image::Bitmap bitmap =
            timed(source.stages, "render", [&] { return gl_->renderer.renderBitmap(texture, view); });
        layOver(bitmap, ground);
        return bitmap;
    }

protected:
    /// Paper mode.
    image::Raster render(Source& source, const asset::View& view) override {
        const gl::PaperTexture texture =
            timed(source.stages, "upload", [&] { return gl::PaperTexture(source.paper->asset); });
        return timed(source.stages, "render", [&] { return gl_->paper.render(texture, view); });
    }

private:
    /// The context comes first: the programs need it for their whole life.
    struct Gl {
        explicit Gl(const gl::RendererOptions& options) : renderer(options) {}

        gl::Context context;
        gl::Renderer renderer;
        gl::PaperRenderer paper;
    };
    gl::RendererOptions options_;
    std::unique_ptr<Gl> gl_;
};

class AssetEngine : public Engine {
protected:
    image::Raster render(Source& source, const asset::View& view) override {
        if (!source.paper && !source.asset->materials.empty())
            printWarning("warning: no GLSL runs on the CPU; materials have their fallback colours");
        return timed(source.stages, "render", [&] {
            return source.paper ? asset::evaluate(source.paper->asset, view, &source.cost.emplace())
                                : asset::evaluate(*source.asset, view);
        });
    }
};

/// The fastest without a GPU, for exact pictures.
class CpuEngine : public Engine {
public:
    image::Raster render(Source& source, const asset::View& view) override {
        if (source.paper || !asset::isSumOfMaps(*source.asset))
            throw std::runtime_error("the cpu engine draws exact pictures only");
        if (!source.asset->materials.empty())
            printWarning("warning: no GLSL runs on the CPU; materials have their fallback colours");
        const asset::Scanner scanner =
            timed(source.stages, "upload", [&] { return asset::Scanner(*source.asset); });
        return timed(source.stages, "render", [&] { return scanner.draw(view); });
    }
};

class ReferenceEngine : public Engine {
public:
    explicit ReferenceEngine(asset::Mode mode) {
        options_.mode = mode == asset::Mode::Exact ? reference::Mode::Exact : reference::Mode::Compat;
    }
    bool needsAsset() const override { return false; }

protected:
    image::Raster render(Source& source, const asset::View& view) override {
        if (!source.scene)
            throw std::runtime_error("the reference engine draws SVG files only, no compiled ones");
        const reference::View same{view.width, view.height, view.toPixels};
        return timed(source.stages, "render",
                     [&] { return reference::render(*source.scene, same, options_); });
    }

private:
    reference::Options options_;
};

}  // namespace

image::Bitmap Engine::draw(Source& source, const asset::View& view, const scene::Color& ground) {
    image::Raster raster = render(source, view);
    layOver(raster, ground);
    return image::toBitmap(raster);
}

std::unique_ptr<Engine> makeEngine(const std::string& name, asset::Mode mode,
                                   const std::string& programCache) {
    if (name == "gl")
        return std::make_unique<GlEngine>(programCache);
    if (name == "cpu")
        return std::make_unique<CpuEngine>();
    if (name == "asset")
        return std::make_unique<AssetEngine>();
    if (name == "reference")
        return std::make_unique<ReferenceEngine>(mode);
    throw UsageError("--engine: '" + name + "' is none of gl, cpu, asset, reference");
}

}  // namespace vtm::tools

#include <vtm/compiler/compile.hpp>
#include <vtm/compiler/draw_view.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/raster/evaluator.hpp>
#include <vtm/raster/scan.hpp>
#include "bench/engines/engine.hpp"
#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

asset::Asset assetOf(const scene::Scene& scene) { return compiler::compile(scene).asset; }
asset::Asset assetOf(const File& file) { return assetOf(load(file)); }

/// As the library draws the first view on the CPU. False where it compiles.
bool drawOnce(const File& file, const asset::View& view, std::vector<std::uint8_t>& bytes) {
    const auto drawing = compiler::ViewDrawing::make(load(file), view);
    if (drawing)
        drawing->draw({bytes.data(), std::size_t(view.width) * 4});
    return drawing != nullptr;
}

gl::RendererOptions optionsOf(gl::Pixels pixels) {
    gl::RendererOptions options;
    options.pixels = pixels;
    return options;
}

/// The asset on the GPU, into 8 bits of a framebuffer.
class GlEngine : public Engine {
public:
    GlEngine(const std::string& name, const std::string& text, std::shared_ptr<gl::Context> context,
             gl::Pixels pixels)
        : Engine(name, text + " on " + context->renderer() + ", " + context->version()),
          context_(std::move(context)),
          renderer_(optionsOf(pixels)),
          drawsOnce_(pixels == gl::Pixels::Automatic && context_->isSoftware()) {}

    void load(const LoadedFile& picture) override { texture_ = renderer_.upload(assetOf(picture.scene)); }

    double draw(const asset::View& view) override {
        return spentTime([&] { renderer_.draw(*texture_, view); });
    }

    std::optional<double> drawCold(const LoadedFile& picture, const asset::View& view) override {
        std::optional<gl::Texture> texture;  // outlives the clock
        std::vector<std::uint8_t> bytes(std::size_t(view.width) * std::size_t(view.height) * 4);
        return spentTime([&] {
            if (drawsOnce_ && drawOnce(picture.file, view, bytes))
                return;
            texture = renderer_.upload(assetOf(picture.file));
            renderer_.draw(*texture, view);
        });
    }

    image::Bitmap pixels(const asset::View& view) override {
        return image::toBitmap(renderer_.render(*texture_, view));
    }

private:
    std::shared_ptr<gl::Context> context_;
    gl::Renderer renderer_;
    const bool drawsOnce_;  ///< as vtm::Picture does where there is no GPU
    std::optional<gl::Texture> texture_;
};

/// The CPU alone, into bytes.
/// What has filters is no sum of maps: asset::Evaluator draws it.
class ScanEngine : public Engine {
public:
    ScanEngine() : Engine("scan", "asset::Scanner, no GL; asset::Evaluator where there are filters") {}

    void load(const LoadedFile& picture) override {
        scanner_.reset();
        evaluator_.reset();
        asset::Asset asset = assetOf(picture.scene);
        if (asset.filters.empty()) {
            scanner_.emplace(asset);
        } else {
            filtered_ = std::move(asset);
            evaluator_.emplace(filtered_);
        }
    }

    double draw(const asset::View& view) override {
        prepareTarget(view);
        return spentTime([&] {
            if (evaluator_)
                evaluator_->draw(view, target(view));
            else
                scanner_->draw(view, target(view));
        });
    }

    std::optional<double> drawCold(const LoadedFile& picture, const asset::View& view) override {
        prepareTarget(view);
        return spentTime([&] {
            if (drawOnce(picture.file, view, bytes_))
                return;
            const asset::Asset asset = assetOf(picture.file);
            if (asset.filters.empty())
                asset::Scanner(asset).draw(view, target(view));
            else
                asset::Evaluator(asset).draw(view, target(view));
        });
    }

    image::Bitmap pixels(const asset::View& view) override {
        return image::toBitmap(evaluator_ ? evaluator_->draw(view) : scanner_->draw(view));
    }

private:
    void prepareTarget(const asset::View& view) {
        bytes_.resize(std::size_t(view.width) * std::size_t(view.height) * 4);
    }

    asset::ByteTarget target(const asset::View& view) { return {bytes_.data(), std::size_t(view.width) * 4}; }

    std::optional<asset::Scanner> scanner_;
    asset::Asset filtered_;
    std::optional<asset::Evaluator> evaluator_;  ///< of filtered_
    std::vector<std::uint8_t> bytes_;
};

}  // namespace

Engines glEngines() {
    Engines engines;
    const auto context = std::make_shared<gl::Context>();
    engines.push_back(
        std::make_unique<GlEngine>("shaders", "gl::Renderer, the shaders", context, gl::Pixels::Shaders));
    engines.push_back(
        std::make_unique<GlEngine>("gl", "gl::Renderer as it is", context, gl::Pixels::Automatic));
    return engines;
}

Engines scanEngines() {
    Engines engines;
    engines.push_back(std::make_unique<ScanEngine>());
    return engines;
}

}  // namespace vtm::bench

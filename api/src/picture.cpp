#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/compiler/view.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/image/encode.hpp>
#include <vtm/svg/load.hpp>
#include <vtm/vtm.hpp>
#include <vtm/vtmtree.hpp>
#include "api/src/picture_state.hpp"
#include "compiler/draw_rows.hpp"

namespace vtm {

namespace {

bool isCompiled(std::span<const std::uint8_t> bytes, const std::string& name) {
    return asset::isContainer(bytes) || name.ends_with(".vtm");
}

asset::Asset readAsset(std::span<const std::uint8_t> bytes, const std::string& name) {
    try {
        return asset::read(bytes);
    } catch (const asset::FormatError& error) {
        throw asset::FormatError(name.empty() ? error.what() : name + ": " + error.what());
    }
}

bool isTreeText(std::span<const std::uint8_t> bytes, const std::string& name) {
    return isTree(bytes) || name.ends_with(".vtmtree");
}

double positive(double value, const char* what) {
    if (!(value > 0 && std::isfinite(value)))
        throw std::invalid_argument(fmt::format("LoadOptions: {} is not a positive number", what));
    return value;
}

svg::Options svgOptions(const LoadOptions& options) {
    svg::Options svg;
    svg.fileName = options.name;
    svg.resourceDirectory = options.folder;
    svg.dpi = positive(options.dpi, "dpi");
    svg.language = options.language;
    svg.fonts = options.fonts;
    svg.defaultFontSize = positive(options.defaultFontSize, "defaultFontSize");
    return svg;
}

std::string textOf(const svg::Warning& warning) {
    return fmt::format("{}:{}:{}: {}", warning.where.file, warning.where.line, warning.where.column,
                       warning.message);
}

}  // namespace

Picture::Picture(scene::Scene scene) : state_(std::make_shared<State>()) {
    scene::validate(scene);
    state_->width = scene.width;
    state_->height = scene.height;
    state_->scene = std::move(scene);
}

Picture::Picture(asset::Asset asset) : state_(std::make_shared<State>()) {
    state_->width = asset.width;
    state_->height = asset.height;
    state_->compiled_[0] = std::make_shared<const Compiled>(std::move(asset));
}

Picture Picture::load(const std::string& path, const LoadOptions& options) {
    LoadOptions named = options;
    named.name = path;
    if (named.folder.empty()) {
        std::error_code none;
        named.folder = std::filesystem::absolute(path, none).parent_path().string();
    }
    return load(image::readFile(path), named);
}

Picture Picture::load(std::span<const std::uint8_t> bytes, const LoadOptions& options) {
    if (isCompiled(bytes, options.name))
        return Picture(readAsset(bytes, options.name));
    if (isTreeText(bytes, options.name))
        return Picture(readTree(bytes, {options.name, options.folder}).toScene());
    svg::Document document = svg::load(bytes, svgOptions(options));
    Picture picture(std::move(document.scene));
    for (const svg::Warning& warning : document.warnings)
        picture.state_->warn(textOf(warning));
    return picture;
}

double Picture::width() const { return state_->width; }

double Picture::height() const { return state_->height; }

std::vector<std::string> Picture::warnings() const { return state_->warnings(); }

const asset::Asset& Picture::asset() const { return state_->whole()->asset; }

void Picture::save(const std::string& path) const { image::writeFile(path, asset::write(asset())); }

const char* version() { return VTM_VERSION; }

namespace {

void checkSize(double width, double height) {
    if (width > asset::maxViewSide || height > asset::maxViewSide ||
        width * height > double(asset::maxViewPixels))
        throw std::length_error(
            fmt::format("{:.10g} x {:.10g} pixels are too many (the limit is {} per side and {} in all)",
                        width, height, asset::maxViewSide, asset::maxViewPixels));
}

void require(bool holds, const char* what) {
    if (!holds)
        throw std::invalid_argument(std::string("RenderOptions: ") + what);
}

void check(const RenderOptions& options) {
    require(options.width.value_or(1) > 0 && options.height.value_or(1) > 0,
            "width and height must be above 0");
    require(std::isfinite(options.scale) && options.scale > 0, "scale must be above 0");
    require(std::isfinite(options.rotation), "rotation must be finite");
    if (const auto& v = options.view)
        require(std::isfinite(v->x) && std::isfinite(v->y) && std::isfinite(v->x + v->width) &&
                    std::isfinite(v->y + v->height) && v->width > 0 && v->height > 0,
                "view must be finite and not empty");
    if (!options.matrix)
        return;
    require(options.width && options.height, "a matrix needs width and height");
    require(!options.view && options.rotation == 0 && options.scale == 1,
            "matrix cannot be combined with view, rotation or scale");
    for (const double number : *options.matrix)
        require(std::isfinite(number), "the matrix must be finite");
}

std::optional<image::Raster> shaded(const Seen& seen, Engine engine) {
    if (engine == Engine::Cpu)
        return std::nullopt;
    return drawWithGl(seen.compiled->asset, seen.view, engine == Engine::Gl);
}

}  // namespace

Shot shotOf(const RenderOptions& options, double pictureWidth, double pictureHeight) {
    check(options);
    if (const auto& m = options.matrix) {
        checkSize(*options.width, *options.height);
        const scene::Affine toPixels{(*m)[0], (*m)[1], (*m)[2], (*m)[3], (*m)[4], (*m)[5]};
        const asset::View view{*options.width, *options.height, toPixels};
        asset::validate(view);
        return {view, std::nullopt};
    }
    const scene::Frame frame = scene::frame({.width = options.width,
                                             .height = options.height,
                                             .scale = options.scale,
                                             .part = options.view,
                                             .rotation = options.rotation,
                                             .placement = {.fit = options.fit}},
                                            pictureWidth, pictureHeight);
    checkSize(frame.width, frame.height);
    return {compiler::viewOf(frame), frame};
}

void Picture::State::drawOnCpu(const Seen& seen, const image::PixelWriter& writer,
                               const image::RowSink& sink) {
    if (!seen.compiled->asset.materials.empty())
        warn("no GLSL runs on the CPU; materials have their fallback colours");
    seen.compiled->cpu.draw(seen.view, writer, sink);
}

void Picture::compileInBackground() const { state_->compileInBackground(); }

Image Picture::render(const RenderOptions& options) const {
    const Shot shot = shotOf(options, state_->width, state_->height);
    Image image;
    image.width = shot.view.width;
    image.height = shot.view.height;
    image.rgba.reserve(std::size_t(image.width) * std::size_t(image.height) * 4);
    const Rgba& ground = options.background;
    const image::PixelWriter writer({ground.r, ground.g, ground.b, ground.a});
    const auto append = [&](std::span<const std::uint8_t> row) {
        image.rgba.insert(image.rgba.end(), row.begin(), row.end());
    };
    const bool isOnCpu = options.engine == Engine::Cpu || (options.engine == Engine::Auto && !glDrawsExact());
    if (const Drawing drawing = isOnCpu ? state_->drawingFor(shot) : nullptr) {
        compiler::drawRows(*drawing, writer, append);
        return image;
    }
    const Seen seen = state_->compileFor(shot);
    const auto raster = shaded(seen, options.engine);
    image.engine = raster ? Engine::Gl : Engine::Cpu;
    if (raster)
        image::giveRows(*raster, writer, append);
    else
        state_->drawOnCpu(seen, writer, append);
    return image;
}

void Image::save(const std::string& path) const {
    const auto format = image::formatOfSuffix(std::filesystem::path(path).extension().string());
    if (!format)
        throw image::CodecError(path + ": the name must end in .png, .jpg, .webp or .ppm");
    image::writeFile(path, image::encode(*this, *format));
}

}  // namespace vtm

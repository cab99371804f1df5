#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <fmt/core.h>

#include <vtm/compiler/view.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/image/encode.hpp>
#include <vtm/vtm.hpp>
#include "api/src/picture_state.hpp"

namespace vtm {

namespace {

void checkSize(double width, double height) {
    if (width > asset::maxViewSide || height > asset::maxViewSide ||
        width * height > double(asset::maxViewPixels))
        throw std::length_error(
            fmt::format("{:.0f} x {:.0f} pixels are too many (at most {} a side and {} in all)", width,
                        height, asset::maxViewSide, asset::maxViewPixels));
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
            "a matrix stands in place of view, rotation and scale");
    for (const double number : *options.matrix)
        require(std::isfinite(number), "the matrix must be finite");
}

/// Premultiplied.
void layOver(image::Raster& picture, const Rgba& ground) {
    if (ground.a == 0)
        return;
    const float under[4] = {ground.r * ground.a, ground.g * ground.a, ground.b * ground.a, ground.a};
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        const float through = 1 - picture.rgba[i + 3];
        for (std::size_t c = 0; c < 4; ++c)
            picture.rgba[i + c] += through * under[c];
    }
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

Image Picture::render(const RenderOptions& options) const {
    const Shot shot = shotOf(options, state_->width, state_->height);
    const Seen seen = state_->compileFor(shot);
    auto raster = shaded(seen, options.engine);
    Image image;
    image.engine = raster ? Engine::Gl : Engine::Cpu;
    if (!raster) {
        if (!seen.compiled->asset.materials.empty())
            state_->warn("no GLSL runs on the CPU; materials have their fallback colours");
        raster = seen.compiled->cpu.draw(seen.view);
    }
    layOver(*raster, options.background);
    static_cast<image::Bitmap&>(image) = image::toBitmap(*raster);
    return image;
}

void Image::save(const std::string& path) const {
    const auto format = image::formatOfSuffix(std::filesystem::path(path).extension().string());
    if (!format)
        throw image::CodecError(path + ": pictures are written as .png, .jpg, .webp or .ppm");
    image::writeFile(path, image::encode(*this, *format));
}

}  // namespace vtm

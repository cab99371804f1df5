#include <filesystem>

#include <fmt/core.h>

#include <vtm/asset/container.hpp>
#include <vtm/image/codec.hpp>
#include <vtm/svg/load.hpp>
#include <vtm/vtm.hpp>
#include "api/src/picture_state.hpp"

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

svg::Options svgOptions(const LoadOptions& options) {
    svg::Options svg;
    svg.fileName = options.name;
    svg.resourceDirectory = options.folder;
    svg.dpi = options.dpi;
    svg.language = options.language;
    svg.fonts = options.fonts;
    return svg;
}

std::string textOf(const svg::Warning& warning) {
    const std::string text = fmt::format("{}:{}:{}: {}", warning.where.file, warning.where.line,
                                         warning.where.column, warning.message);
    return warning.count == 1 ? text : fmt::format("{} ({} places)", text, warning.count);
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
    state_->whole_ = std::make_shared<const Compiled>(std::move(asset));
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

}  // namespace vtm

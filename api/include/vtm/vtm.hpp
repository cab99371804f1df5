/// \file
/// Pictures in three lines:
///
///     auto picture = vtm::Picture::load("tiger.svg");
///     picture.render({.width = 800}).save("tiger.png");
///     vtm::gl::Texture texture = picture.texture();  // with <vtm/gl/renderer.hpp>, linked with vtm::gl
///
/// The parts that this puts together have headers of their own: <vtm/svg/load.hpp>,
/// <vtm/compiler/compile.hpp>, <vtm/raster/scan.hpp>, <vtm/gl/renderer.hpp>.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vtm/error.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/text/font_options.hpp>

#pragma GCC visibility push(default)

namespace vtm {

namespace scene {
struct Scene;
}
namespace asset {
struct Asset;
struct AssetView;
}  // namespace asset
namespace gl {
class Texture;
}

using scene::Fit;

/// A rectangle in user units, from (x, y), y downwards.
using Rectangle = scene::Rect;

/// Straight (not premultiplied) sRGB, each channel in [0, 1].
struct Rgba {
    float r = 0, g = 0, b = 0, a = 1;
};

struct LoadOptions {
    std::string name = {};  ///< of bytes, for messages; files have their own
    std::string folder =
        {};  ///< where an SVG's relative references start; of a file, the file's; empty: none are read
    double dpi = 96;              ///< pixels an inch, for lengths in physical units
    std::string language = "en";  ///< of text, and for systemLanguage
    text::FontOptions fonts = {};
};

/// The engine that draws.
enum class Engine {
    Auto,  ///< shaders where there is a GPU, else the CPU
    Cpu,
    Gl  ///< shaders, on a software driver too
};

struct RenderOptions {
    /// Pixels. One of them alone keeps the aspect; both: `fit` decides; neither: `scale` pixels a user unit.
    std::optional<int> width = {}, height = {};
    double scale = 1;
    Fit fit = Fit::Contain;
    std::optional<Rectangle> view = {};  ///< the part that is shown; the whole picture by default
    double rotation = 0;                 ///< degrees, clockwise
    /// In place of scale, fit, view and rotation: maps user units to pixels, y down, as SVG's matrix(a b c d
    /// e f). It may shear and mirror. Needs width and height.
    std::optional<std::array<double, 6>> matrix = {};
    Rgba background = {0, 0, 0, 0};
    Engine engine = Engine::Auto;
};

/// A rendered image: 8-bit straight sRGB with alpha, rows from the top, no padding.
class Image : public image::Bitmap {
public:
    Engine engine = Engine::Cpu;  ///< the engine that drew it: Cpu or Gl

    /// Into a file in the format of its suffix: .png, .jpg, .webp (without loss) or .ppm. JPEG and PPM have
    /// no alpha: draw on a background for them. Written whole or not at all. Throws image::CodecError.
    void save(const std::string& path) const;
};

/// A picture: an SVG file, a compiled .vtm file or a scene. It is compiled when that is first needed, and
/// again for views that want finer outlines than it has. Copies share all of it. Safe to use from several
/// threads at once.
class Picture {
public:
    /// .svg, .svgz or .vtm; the bytes decide which. Throws svg::ParseError, asset::FormatError,
    /// image::CodecError.
    static Picture load(const std::string& path, const LoadOptions& options = {});
    static Picture load(std::span<const std::uint8_t> bytes, const LoadOptions& options = {});
    /// Throws scene::InvalidScene.
    explicit Picture(scene::Scene scene);
    /// The asset must be valid (asset::validate).
    explicit Picture(asset::Asset asset);

    double width() const;   ///< user units
    double height() const;  ///< user units

    /// What was left out or repaired so far, by the importer, the compiler and the engines, each once:
    /// `file:line:column: what`, or without a place.
    std::vector<std::string> warnings() const;

    /// Throws std::invalid_argument for options that contradict each other, std::length_error for more pixels
    /// than asset::maxViewSide and maxViewPixels, compiler::LimitError, gl::GlError with Engine::Gl.
    Image render(const RenderOptions& options = {}) const;

    /// Returns the compiled asset for use with the library's parts, made with the default compiler::Options
    /// (1/65536 of the longer side). Valid while a copy of the picture lives.
    const asset::Asset& asset() const;

    /// Compiles the picture and writes it to a .vtm file.
    void save(const std::string& path) const;

    /// Uploads the picture to the current GL context, for drawing with gl::Texture::draw. Part of the
    /// component gl.
    gl::Texture texture() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

/// Returns the version, for example "0.2.0".
const char* version();

}  // namespace vtm

#pragma GCC visibility pop

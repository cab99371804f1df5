/// \file
/// Loads pictures and renders them:
///
///     auto picture = vtm::Picture::load("tiger.svg");
///     picture.render({.width = 800}).save("tiger.png");
///     vtm::gl::Texture texture = picture.texture();  // with <vtm/gl/renderer.hpp>, linked with vtm::gl
///
/// The stages behind it have headers of their own: <vtm/svg/load.hpp>, <vtm/compiler/compile.hpp>,
/// <vtm/raster/scan.hpp>, <vtm/gl/renderer.hpp>.
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

/// A rectangle in user units; (x, y) is its min corner, y down.
using Rectangle = scene::Rect;

/// Straight (not premultiplied) sRGB, each channel in [0, 1].
struct Rgba {
    float r = 0, g = 0, b = 0, a = 1;
};

struct LoadOptions {
    /// Used in messages when a picture is loaded from memory; a file is named by its path.
    std::string name = {};
    /// Folder to which relative references of an SVG or .vtmtree file refer. Empty: the folder of the file;
    /// from memory, relative references are not read.
    std::string folder = {};
    double dpi = 96;              ///< pixels an inch, for lengths in physical units; > 0
    std::string language = "en";  ///< of text, and for systemLanguage
    text::FontOptions fonts = {};
    double defaultFontSize = 12;  ///< user units, of text without a size; > 0
};

/// The engine that draws.
enum class Engine {
    Auto,  ///< shaders where there is a GPU, otherwise the CPU
    Cpu,
    Gl  ///< shaders, also on a software driver
};

struct RenderOptions {
    /// Pixels, > 0. With one of them the aspect ratio is kept; with both `fit` applies; with neither `scale`.
    std::optional<int> width = {}, height = {};
    double scale = 1;  ///< pixels per user unit, > 0
    Fit fit = Fit::Contain;
    std::optional<Rectangle> view = {};  ///< the visible part; the whole picture by default
    double rotation = 0;                 ///< degrees, clockwise
    /// Replaces scale, fit, view and rotation: SVG's matrix(a b c d e f) from user units to pixels, y down.
    /// It may shear and mirror. Needs width and height.
    std::optional<std::array<double, 6>> matrix = {};
    Rgba background = {0, 0, 0, 0};  ///< transparent by default
    Engine engine = Engine::Auto;
};

/// A rendered image: 8-bit straight sRGB with alpha, rows from the top, no padding.
class Image : public image::Bitmap {
public:
    Engine engine = Engine::Cpu;  ///< the engine that drew it: Cpu or Gl

    /// Writes a file in the format of its suffix: .png, .jpg, .webp (lossless) or .ppm. JPEG and PPM have no
    /// alpha: render on an opaque background for them. On failure no file is left or changed. Throws
    /// image::CodecError.
    void save(const std::string& path) const;
};

/// A picture: an SVG file, a text of VTMs (.vtmtree), a compiled .vtm file or a scene. On the CPU the first
/// view is drawn from the scene itself; the second one compiles the picture, from which all others are drawn
/// fast. Views that show the whole picture in more than 1024 pixels have assets of their own, made in the
/// same way, up to 4096 and 16 384 pixels; views that need finer outlines are drawn from the scene each time.
/// With shaders it is compiled on first use. Copies share its data. All functions may be called in several
/// threads at once.
class Picture {
public:
    /// Loads an SVG file, gzip-compressed or not, a .vtmtree file (vtm/vtmtree.hpp) or a .vtm file; the bytes
    /// decide which. Throws svg::ParseError, TreeError, asset::FormatError, image::CodecError.
    static Picture load(const std::string& path, const LoadOptions& options = {});
    /// The same from memory, which is not needed afterwards.
    static Picture load(std::span<const std::uint8_t> bytes, const LoadOptions& options = {});
    /// Takes a scene. Throws scene::InvalidScene.
    explicit Picture(scene::Scene scene);
    /// Takes a compiled asset, which must be valid (asset::validate).
    explicit Picture(asset::Asset asset);

    double width() const;   ///< user units
    double height() const;  ///< user units

    /// Returns what the importer, the compiler and the engines have left out or repaired so far, each warning
    /// once: `file:line:column: message`, or without a place.
    std::vector<std::string> warnings() const;

    /// Renders the picture. Throws std::invalid_argument for options out of range or in contradiction,
    /// std::length_error for more pixels than asset::maxViewSide and maxViewPixels, compiler::LimitError, and
    /// gl::GlError with Engine::Gl.
    Image render(const RenderOptions& options = {}) const;

    /// Compiles the picture in a thread of its own, unless that was done before, so that views to come need
    /// not wait for it, or wait less. The last copy of the picture waits for it when it is destroyed.
    void compileInBackground() const;

    /// Returns the compiled asset, made with the default compiler::Options (tolerance 1/65536 of the longer
    /// side), for use with the library's other headers. Valid while a copy of the picture exists. Throws
    /// compiler::LimitError.
    const asset::Asset& asset() const;

    /// Compiles the picture as asset() does and writes it to a .vtm file. Throws compiler::LimitError,
    /// image::CodecError.
    void save(const std::string& path) const;

    /// Uploads the picture to the current GL context, for drawing with gl::Texture::draw. Needs the library
    /// vtm::gl. Throws gl::GlError.
    gl::Texture texture() const;

private:
    struct __attribute__((visibility("hidden"))) State;
    std::shared_ptr<State> state_;
};

/// Returns the version, for example "0.2.0".
const char* version();

}  // namespace vtm

#pragma GCC visibility pop

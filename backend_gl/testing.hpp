/// \file
/// Drawing with a fragment shader of one's own, for the tests of textures.
#pragma once

#include <memory>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <vtm/gl/sampled_texture.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/raster/view.hpp>

namespace vtm::gl::test {

/// A program over a whole raster. Needs a current context for its whole life.
class ShaderCanvas {
public:
    /// `text` follows the include and defines `vec4 shade(vec2 pixel)`; pixel (i, j) is asked for at (i +
    /// 0.5, j + 0.5), j downwards. `vertices`, if given, is the vertex shader: of a strip of four. Throws
    /// GlError with the driver's log.
    ShaderCanvas(const std::string& include, const std::string& text, const std::string& vertices = {});
    ~ShaderCanvas();
    ShaderCanvas(const ShaderCanvas&) = delete;
    ShaderCanvas& operator=(const ShaderCanvas&) = delete;

    unsigned program() const;
    /// Sets a `uniform mat3`.
    void set(const char* name, const glm::dmat3& value);
    /// Single precision, unclamped. Throws GlError.
    image::Raster draw(int width, int height);
    /// Draws and waits, without reading back.
    void drawOnly(int width, int height);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// One texture on a plane.
class TextureCanvas {
public:
    explicit TextureCanvas(const asset::AssetView& asset);

    image::Raster draw(const asset::View& view, Wrapping wrapping = {});
    /// `toPicture` maps (pixel, 1) to homogeneous (s, t).
    image::Raster draw(const glm::dmat3& toPicture, int width, int height, Wrapping wrapping = {});

private:
    glm::dvec2 size_;
    SampledTexture texture_;
    ShaderCanvas canvas_;
};

}  // namespace vtm::gl::test

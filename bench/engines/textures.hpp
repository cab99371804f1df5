/// \file
/// A picture as a texture on a plane: by vtm_sample, or as a mip-mapped bitmap.
#pragma once

#include <cstddef>
#include <string>

#include <GLES3/gl3.h>
#include <glm/mat3x3.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/sampled_texture.hpp>
#include <vtm/image/bitmap.hpp>
#include "backend_gl/testing.hpp"

namespace vtm::bench {

/// One way to have a picture as a texture. Needs a current context for its whole life.
class TextureWay {
public:
    /// `sample` defines `vec4 sampled(vec3 stq)`; `taken` is the size that `bytes` says.
    TextureWay(std::string called, const std::string& include, const std::string& sample, std::size_t taken);
    virtual ~TextureWay() = default;
    TextureWay(const TextureWay&) = delete;
    TextureWay& operator=(const TextureWay&) = delete;

    /// `toTexture`: (pixel, 1) to homogeneous (s, t). Into RGBA32F; waits.
    void drawOnly(const glm::dmat3& toTexture, int side);
    image::Raster draw(const glm::dmat3& toTexture, int side);

    const std::string name;
    const std::size_t bytes;

protected:
    /// Of vtm_sample, for the uniform `picture`.
    static const char* const sampleVtm;

private:
    virtual void bind(GLuint program) = 0;

    gl::test::ShaderCanvas canvas_;
};

class AssetWay : public TextureWay {
public:
    /// `taken`: 0 for all that is on the GPU.
    AssetWay(const char* called, const asset::Asset& picture, gl::Wrapping wrapping = {},
             std::size_t taken = 0);

private:
    AssetWay(const char* called, const asset::Asset& picture, gl::Wrapping wrapping, std::size_t taken,
             gl::SampledTexture texture);
    void bind(GLuint program) override { texture_.bind(program, "picture", 0, wrapping_); }

    gl::SampledTexture texture_;
    gl::Wrapping wrapping_;
};

/// A mip-mapped bitmap, as exact as bytes can be, with trilinear filtering and 16 × anisotropy where the
/// driver has it.
class BitmapWay : public TextureWay {
public:
    enum class Beyond { Transparent, Repeated };

    /// `longer`: pixels of the longer side.
    BitmapWay(std::string called, const asset::Asset& picture, int longer,
              Beyond beyond = Beyond::Transparent);
    ~BitmapWay() override { glDeleteTextures(1, &texture_); }

private:
    void bind(GLuint program) override;

    GLuint texture_ = 0;
};

/// The mean over `samples`² points a pixel, each with a footprint as small as that.
image::Raster truthOf(TextureWay& exact, const glm::dmat3& toTexture, int side, int samples);

}  // namespace vtm::bench

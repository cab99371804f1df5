#include "bench/engines/textures.hpp"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <vtm/raster/scan.hpp>

namespace vtm::bench {

namespace {

constexpr GLenum maxAnisotropy = 0x84FE;  // GL_TEXTURE_MAX_ANISOTROPY_EXT

glm::ivec2 sizeOf(const asset::Asset& picture, int longer) {
    const glm::dvec2 size(picture.width, picture.height);
    return glm::max(glm::ivec2(glm::round(size * (longer / std::max(size.x, size.y)))), 1);
}

std::string bitmapSample(BitmapWay::Beyond beyond) {
    const std::string inside =
        beyond == BitmapWay::Beyond::Transparent ? " * float(all(equal(st, clamp(st, 0.0, 1.0))))" : "";
    return R"(
uniform sampler2D bitmap;
vec4 sampled(vec3 stq) {
    vec2 st = stq.xy / stq.z;
    return texture(bitmap, st))" +
           inside + ";\n}";
}

std::size_t bytesOf(glm::ivec2 size) { return std::size_t(size.x) * std::size_t(size.y) * 4 * 4 / 3; }

}  // namespace

const char* const TextureWay::sampleVtm = R"(
uniform Vtm picture;
vec4 sampled(vec3 stq) { return vtm_sample_proj(picture, stq / gl_FragCoord.w); })";

TextureWay::TextureWay(std::string called, const std::string& include, const std::string& sample,
                       std::size_t taken)
    : name(std::move(called)), bytes(taken), canvas_(include, R"(
uniform mat3 toTexture;
)" + sample + R"(
vec4 shade(vec2 pixel) { return sampled(toTexture * vec3(pixel, 1.0)); })") {}

void TextureWay::drawOnly(const glm::dmat3& toTexture, int side) {
    bind(canvas_.program());
    canvas_.set("toTexture", toTexture);
    canvas_.drawOnly(side, side);
}

image::Raster TextureWay::draw(const glm::dmat3& toTexture, int side) {
    bind(canvas_.program());
    canvas_.set("toTexture", toTexture);
    return canvas_.draw(side, side);
}

AssetWay::AssetWay(const char* called, const asset::Asset& picture, gl::Wrapping wrapping, std::size_t taken)
    : AssetWay(called, picture, wrapping, taken, gl::SampledTexture(picture)) {}

AssetWay::AssetWay(const char* called, const asset::Asset& picture, gl::Wrapping wrapping, std::size_t taken,
                   gl::SampledTexture texture)
    : TextureWay(called, gl::sampleInclude({picture}), sampleVtm, taken == 0 ? texture.bytes() : taken),
      texture_(std::move(texture)),
      wrapping_(wrapping) {}

BitmapWay::BitmapWay(std::string called, const asset::Asset& picture, int longer, Beyond beyond)
    : TextureWay(std::move(called), "precision highp float;\n", bitmapSample(beyond),
                 bytesOf(sizeOf(picture, longer))) {
    const glm::ivec2 size = sizeOf(picture, longer);
    asset::View view{size.x, size.y, {}};
    view.toPixels = {size.x / picture.width, 0, 0, size.y / picture.height, 0, 0};
    const image::Bitmap bitmap = image::toBitmap(asset::Scanner(picture).draw(view));
    const GLint wrap = beyond == Beyond::Repeated ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 bitmap.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, maxAnisotropy, 16);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    while (glGetError() != GL_NO_ERROR) {
    }  // a driver without anisotropy
}

void BitmapWay::bind(GLuint program) {
    glUseProgram(program);
    glUniform1i(glGetUniformLocation(program, "bitmap"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindSampler(0, 0);
    glBindTexture(GL_TEXTURE_2D, texture_);
}

image::Raster truthOf(TextureWay& exact, const glm::dmat3& toTexture, int side, int samples) {
    const glm::dmat3 smaller({1.0 / samples, 0, 0}, {0, 1.0 / samples, 0}, {0, 0, 1});
    const image::Raster fine = exact.draw(toTexture * smaller, side * samples);
    image::Raster mean(side, side);
    for (int y = 0; y < side * samples; ++y)
        for (int x = 0; x < side * samples; ++x)
            for (std::size_t c = 0; c < 4; ++c)
                mean.rgba[4 * (std::size_t(y / samples) * side + x / samples) + c] +=
                    fine.rgba[4 * (std::size_t(y) * side * samples + x) + c] / float(samples * samples);
    return mean;
}

}  // namespace vtm::bench

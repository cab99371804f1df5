#include "paper/gl/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

#include <glm/matrix.hpp>

#include "backend_gl/core/program.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/output/target.hpp"
#include "backend_gl/upload/upload.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/programs.hpp"
#include "paper/gl/texels.hpp"

namespace vtm::paper {

using namespace gl;

namespace {

using glm::dmat2;
using glm::dvec2;

/// Larger views are drawn in parts of at most this side.
constexpr int maxPartSide = 4096;

int partSide() {
    GLint viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min({maxPartSide, limit(GL_MAX_TEXTURE_SIZE), viewport[0], viewport[1]});
}

asset::Asset packed(const Asset& asset, Sections& sections) {
    asset::Asset result = asset.palette;
    sections = appendTexels(asset, result.data);
    return result;
}

void setUniforms(const Program& program, const asset::View& view) {
    const dmat2 linear(view.toPixels[0], view.toPixels[1]), inverse = glm::inverse(linear);
    const dvec2 pixel = dvec2(view.width, view.height) * 0.5, picture = inverse * (pixel - view.toPixels[2]);
    const Footprint footprint(linear);
    const float normals[4] = {float(inverse[0].x), float(inverse[1].x), float(inverse[0].y),
                              float(inverse[1].y)};
    glUniformMatrix2fv(program.uniform("pixelNormals"), 1, GL_FALSE, normals);
    glUniform1f(program.uniform("pixelLonger"), float(footprint.longer));
    glUniform4f(program.uniform("pixelToPicture"), float(inverse[0].x), float(inverse[0].y),
                float(inverse[1].x), float(inverse[1].y));
    glUniform4f(program.uniform("pictureAnchor"), float(picture.x), float(picture.y), float(pixel.x),
                float(pixel.y));
}

void clamp(image::Raster& raster) {
    std::ranges::transform(raster.rgba, raster.rgba.begin(),
                           [](float v) { return std::clamp(v, 0.0f, 1.0f); });
}

void bindTexture(Unit unit, const TextureHandle& texture) {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, texture.get());
}

}  // namespace

/// Of Programs, which paper mode does without: its texture keeps its materials itself.
constexpr unsigned noMaterialSet = 0;

struct Texture::Impl {
    explicit Impl(const Asset& asset)
        : uploaded(packed(asset, sections), noMaterialSet),
          materials(asset.palette.materials),
          width(asset.width),
          height(asset.height),
          root(asset.root) {
        for (const Mask& mask : asset.masks)
            widestWithoutMips =
                std::min(widestWithoutMips, std::ldexp(mask.side, -int(mask.mip.sizeLog2 + 1)));
    }

    Sections sections;  // before `uploaded`, which sets it
    UploadedAsset uploaded;
    std::vector<asset::Material> materials;
    double width, height;
    std::uint32_t root;
    /// Pixels up to this size, picture units, need no mip of any mask (maskCoverage).
    double widestWithoutMips = std::numeric_limits<double>::infinity();
};

Texture::Texture(const Asset& asset) {
    requireContext();
    const StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(asset);
}
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;

struct Renderer::Impl {
    explicit Impl(StateContract c) : contract(std::move(c)) {}

    StateContract contract;
    /// By the features of the paints, the materials' text and the parts.
    std::map<std::tuple<unsigned, std::string, MapParts>, Program> programs;
    TargetPool pool;
    VertexArrayHandle vertexArray = makeVertexArray();

    const Program& program(const Texture::Impl& texture, MapParts parts) {
        const Features features = texture.uploaded.features;
        const std::string materials =
            features.has(Features::Material) ? materialsSource(texture.materials) : "";
        const std::tuple key(features.flags(), materials, parts);
        auto found = programs.find(key);
        if (found == programs.end()) {
            try {
                found = programs.emplace(key, Program(mapSource(features, materials, parts))).first;
            } catch (const GlError& error) {
                throw GlError(blamedOnMaterial(texture.materials, error.what()));
            }
        }
        return found->second;
    }

    const Program& bind(const Texture::Impl& texture, MapParts parts) {
        const Program& p = program(texture, parts);
        const gl::Sections& s = texture.uploaded.sections;
        p.use();
        bindTexture(Unit::Texels, texture.uploaded.records.texture());
        bindTexture(Unit::Images, texture.uploaded.images);
        glUniform1i(p.uniform("texels"), int(Unit::Texels));
        glUniform1i(p.uniform("images"), int(Unit::Images));
        glUniform4ui(p.uniform("sections"), s.leaves, s.pieces, s.paints, s.data);
        glUniform1ui(p.uniform("imageSection"), s.images);
        glUniform1ui(p.uniform("rampSums"), s.rampSums);
        glUniform2ui(p.uniform("paperSections"), texture.sections.masks, texture.sections.nodes);
        glUniform2f(p.uniform("pictureSize"), float(texture.width), float(texture.height));
        glUniform1ui(p.uniform("rootNode"), texture.root);
        return p;
    }

    /// Calls draw() with a target bound, whose making binds a texture, and reads it back into rows of so many
    /// pixels.
    template <class Draw>
    void drawInto(float* pixels, int rowLength, glm::ivec2 size, Draw&& draw) {
        Target target = pool.take(size);
        glViewport(0, 0, size.x, size.y);
        target.bind();
        target.touch({{0, 0}, size});
        draw();
        glPixelStorei(GL_PACK_ROW_LENGTH, rowLength);
        glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, pixels);
        pool.giveBack(std::move(target));
        pool.dropUnused();
        checkErrors("drawing in paper mode");
    }

    void drawPart(const Texture::Impl& texture, const asset::View& part, float* pixels, int rowLength) {
        drawInto(pixels, rowLength, {part.width, part.height}, [&] {
            const Footprint pixel(dmat2(part.toPixels[0], part.toPixels[1]));
            setUniforms(bind(texture, {Shown::View, pixel.longer > texture.widestWithoutMips}), part);
            glBindVertexArray(vertexArray.get());
            glDrawArrays(GL_TRIANGLES, 0, 3);
        });
    }

    void drawSurface(const Texture::Impl& texture, const Surface& surface, image::Raster& raster) {
        const UploadedSurface uploaded(surface);
        drawInto(raster.rgba.data(), raster.width, {raster.width, raster.height}, [&] {
            bind(texture, {Shown::Surface, true});
            uploaded.draw();
        });
    }
};

Renderer::Renderer() {
    requireContext();
    StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(contract);
}
Renderer::~Renderer() = default;

image::Raster Renderer::render(const Texture& texture, const asset::View& view) {
    asset::validate(view);
    image::Raster raster(view.width, view.height);
    if (texture.impl_->root == noIndex || !isInvertible(view))
        return raster;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    const int side = partSide();
    for (int y = 0; y < view.height; y += side)
        for (int x = 0; x < view.width; x += side) {
            asset::View part = view;
            part.width = std::min(side, view.width - x);
            part.height = std::min(side, view.height - y);
            part.toPixels[2] -= dvec2(x, y);
            impl_->drawPart(*texture.impl_, part, raster.pixel(x, y), view.width);
        }
    clamp(raster);
    return raster;
}

image::Raster Renderer::render(const Texture& texture, const Surface& surface, glm::ivec2 size) {
    if (std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > partSide())
        throw std::length_error("a side of the surface's raster is out of range");
    image::Raster raster(size.x, size.y);
    if (texture.impl_->root == noIndex)
        return raster;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->drawSurface(*texture.impl_, surface, raster);
    clamp(raster);
    return raster;
}

}  // namespace vtm::paper

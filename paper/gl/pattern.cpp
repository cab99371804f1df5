#include "paper/gl/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "backend_gl/core/placement.hpp"
#include "backend_gl/core/program.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/pattern_tables.hpp"
#include "paper/gl/programs.hpp"

namespace vtm::paper {

using namespace gl;

namespace {

using glm::dvec2;

template <class Texel>
TextureHandle upload(const Texels<Texel>& texels, GLenum format, GLenum layout, GLenum type) {
    TextureHandle texture = makeTexture(format, int(texels.width), int(texels.height));
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(texels.width), GLsizei(texels.height), layout, type,
                    texels.values.data());
    checkErrors("upload of a pattern");
    return texture;
}

TextureHandle uploadMip(const Mip& mip) {
    GLuint id = 0;
    glGenTextures(1, &id);
    TextureHandle texture(id);
    glBindTexture(GL_TEXTURE_2D, id);
    glTexStorage2D(GL_TEXTURE_2D, GLsizei(mip.sizeLog2 + 1), GL_R8, 1 << mip.sizeLog2, 1 << mip.sizeLog2);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::uint8_t* texels = mip.texels.data();
    for (unsigned level = 0; level <= mip.sizeLog2; ++level) {
        const GLsizei side = 1 << (mip.sizeLog2 - level);
        glTexSubImage2D(GL_TEXTURE_2D, GLint(level), 0, 0, side, side, GL_RED, GL_UNSIGNED_BYTE, texels);
        texels += std::size_t(side) * std::size_t(side);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    checkErrors("upload of a mip");
    return texture;
}

/// Of a pixel so wide that the mip has its part, all, or none: it is not asked for what has no weight.
enum class Reach { Near, Between, Far };

ProgramSource sourceOf(PatternForm form, unsigned depth, Reach range) {
    return patternSource({form.compressed, form.filtered, form.linear, range != Reach::Far,
                          form.filtered && range != Reach::Near, depth});
}

ProgramSource surfaceSourceOf(PatternForm form, unsigned depth) {
    return patternSource({.compressed = form.compressed,
                          .filtered = form.filtered,
                          .linear = form.linear,
                          .mip = form.filtered,
                          .depth = depth,
                          .shown = Shown::Surface});
}

void requireSides(glm::ivec2 size) {
    if (std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > asset::maxViewSide)
        throw std::length_error("a side of the surface's raster is out of range");
}

/// From the framebuffer that is bound.
void read(image::Raster& raster) {
    std::vector<std::uint8_t> bytes(raster.rgba.size());
    glReadPixels(0, 0, raster.width, raster.height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    checkErrors("reading a pattern");
    std::ranges::transform(bytes, raster.rgba.begin(), [](std::uint8_t b) { return float(b) / 255; });
}

}  // namespace

std::string patternShader(PatternForm form, unsigned depth, Shown shown) {
    return joined(
        (shown == Shown::Surface ? surfaceSourceOf(form, depth) : sourceOf(form, depth, Reach::Between))
            .fragment);
}

struct Pattern::Impl {
    Impl(const Mask& mask, PatternForm f, StateContract c)
        : form(f),
          contract(std::move(c)),
          depth(std::max(1u, patternDepth(mask))),
          mipLog2(mask.mip.sizeLog2) {
        const PatternTables t = form.compressed ? treeTables(mask, depth) : gridTables(mask, depth);
        places = upload(t.places, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT);
        cells = upload(t.cells, GL_RGBA32F, GL_RGBA, GL_FLOAT);
        bytes = t.places.bytes() + t.cells.bytes();
        if (form.filtered) {
            mip = uploadMip(mask.mip);
            bytes += mask.mip.texels.size();
        }
    }

    const Program& programOf(Reach range) {
        auto found = programs.find(range);
        if (found == programs.end())
            found = programs.emplace(range, compiled(sourceOf(form, depth, range))).first;
        return found->second;
    }
    const Program& surfaceProgram() {
        if (!onSurfaces)
            onSurfaces.emplace(compiled(surfaceSourceOf(form, depth)));
        return *onSurfaces;
    }
    static Program compiled(const ProgramSource& source) {
        Program program(source);
        program.use();
        glUniform1i(program.uniform("places"), 0);
        glUniform1i(program.uniform("cells"), 1);
        glUniform1i(program.uniform("mip"), 2);
        glUniform4f(program.uniform("insideColor"), 1, 1, 1, 1);
        glUniform4f(program.uniform("outsideColor"), 0, 0, 0, 0);
        return program;
    }

    /// Leaves its framebuffer bound.
    void draw(const asset::View& view) {
        bindTarget({view.width, view.height});
        const glm::dmat2 linear(view.toPixels[0], view.toPixels[1]), inverse = glm::inverse(linear);
        const dvec2 origin = inverse * -view.toPixels[2];
        // As maskCoverage, which counts the analytic coverage as level 0.
        const double lod = std::log2(Footprint(linear).longer) + mipLog2;
        const Reach range = !form.filtered || lod <= -1 ? Reach::Near : lod < 0 ? Reach::Between : Reach::Far;
        const Program& program = programOf(range);
        const float toPattern[6] = {float(inverse[0].x), float(inverse[0].y), float(inverse[1].x),
                                    float(inverse[1].y), float(origin.x),     float(origin.y)};
        program.use();
        bindTextures(range == Reach::Between ? GL_LINEAR : GL_LINEAR_MIPMAP_LINEAR);
        glUniformMatrix3x2fv(program.uniform("toPattern"), 1, GL_FALSE, toPattern);
        glUniform1f(program.uniform("lod"), float(lod));
        glBindVertexArray(vertexArray.get());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glFinish();
        checkErrors("drawing a pattern");
    }

    /// Leaves its framebuffer bound.
    void draw(const UploadedSurface& surface, glm::ivec2 size) {
        bindTarget(size);
        const GLfloat nothing[4] = {};
        glClearBufferfv(GL_COLOR, 0, nothing);
        const Program& program = surfaceProgram();
        program.use();
        bindTextures(GL_LINEAR_MIPMAP_LINEAR);
        glUniform1f(program.uniform("mipLog2"), float(mipLog2));
        surface.draw();
        glFinish();
        checkErrors("drawing a pattern on a surface");
    }

    void bindTarget(glm::ivec2 size) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
        if (size != targetSize) {
            target = makeTexture(GL_RGBA8, size.x, size.y);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
            targetSize = size;
        }
        glViewport(0, 0, size.x, size.y);
    }

    /// Before level 0 one level is read.
    void bindTextures(GLint mipFilter) const {
        const TextureHandle* textures[] = {&places, &cells, &mip};
        for (GLenum i = 0; i < 3; ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            glBindTexture(GL_TEXTURE_2D, textures[i]->get());
        }
        if (form.filtered)
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, mipFilter);
    }

    PatternForm form;
    StateContract contract;
    unsigned depth, mipLog2;
    std::map<Reach, Program> programs;  ///< of views, compiled when first needed
    std::optional<Program> onSurfaces;
    VertexArrayHandle vertexArray = makeVertexArray();
    FramebufferHandle framebuffer = makeFramebuffer();
    TextureHandle places, cells, mip, target;
    std::size_t bytes = 0;
    glm::ivec2 targetSize{0};
};

Pattern::Pattern(const Mask& mask, PatternForm form) {
    requireContext();
    dropErrors();
    StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(mask, form, contract);
}
Pattern::~Pattern() = default;

std::size_t Pattern::bytes() const { return impl_->bytes; }

void Pattern::draw(const asset::View& view) {
    asset::validate(view);
    if (view.width == 0 || view.height == 0 || !isInvertible(view))
        return;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->draw(view);
}

image::Raster Pattern::render(const asset::View& view) {
    asset::validate(view);
    image::Raster raster(view.width, view.height);
    if (raster.rgba.empty() || !isInvertible(view))
        return raster;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->draw(view);
    read(raster);
    return raster;
}

void Pattern::draw(const UploadedSurface& surface, glm::ivec2 size) {
    requireSides(size);
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->draw(surface, size);
}

image::Raster Pattern::render(const UploadedSurface& surface, glm::ivec2 size) {
    requireSides(size);
    image::Raster raster(size.x, size.y);
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->draw(surface, size);
    read(raster);
    return raster;
}

}  // namespace vtm::paper

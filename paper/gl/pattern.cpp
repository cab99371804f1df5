#include "paper/gl/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
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

}  // namespace

std::string patternShader(PatternForm form, unsigned depth) {
    return joined(sourceOf(form, depth, Reach::Between).fragment);
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
        if (found == programs.end()) {
            found = programs.emplace(range, Program(sourceOf(form, depth, range))).first;
            const Program& program = found->second;
            program.use();
            glUniform1i(program.uniform("places"), 0);
            glUniform1i(program.uniform("cells"), 1);
            glUniform1i(program.uniform("mip"), 2);
            glUniform4f(program.uniform("insideColor"), 1, 1, 1, 1);
            glUniform4f(program.uniform("outsideColor"), 0, 0, 0, 0);
        }
        return found->second;
    }

    /// Leaves its framebuffer bound.
    void draw(const asset::View& view) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
        if (view.width != width || view.height != height) {
            target = makeTexture(GL_RGBA8, view.width, view.height);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
            width = view.width;
            height = view.height;
        }
        const glm::dmat2 linear(view.toPixels[0], view.toPixels[1]), inverse = glm::inverse(linear);
        const dvec2 origin = inverse * -view.toPixels[2];
        // As maskCoverage, which counts the analytic coverage as level 0.
        const double lod = std::log2(Footprint(linear).longer) + mipLog2;
        const Program& program = programOf(!form.filtered || lod <= -1 ? Reach::Near
                                           : lod < 0                   ? Reach::Between
                                                                       : Reach::Far);
        const glm::mat2 pixelInPeriods(inverse);
        const float toPattern[6] = {float(inverse[0].x), float(inverse[0].y), float(inverse[1].x),
                                    float(inverse[1].y), float(origin.x),     float(origin.y)};
        glViewport(0, 0, width, height);
        glBindVertexArray(vertexArray.get());
        program.use();
        const TextureHandle* textures[] = {&places, &cells, &mip};
        for (GLenum i = 0; i < 3; ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            glBindTexture(GL_TEXTURE_2D, textures[i]->get());
        }
        glUniformMatrix2fv(program.uniform("pixelInPeriods"), 1, GL_FALSE, &pixelInPeriods[0][0]);
        glUniformMatrix3x2fv(program.uniform("toPattern"), 1, GL_FALSE, toPattern);
        glUniform1f(program.uniform("lod"), float(lod));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glFinish();
        checkErrors("drawing a pattern");
    }

    PatternForm form;
    StateContract contract;
    unsigned depth, mipLog2;
    std::map<Reach, Program> programs;  ///< compiled when first needed
    VertexArrayHandle vertexArray = makeVertexArray();
    FramebufferHandle framebuffer = makeFramebuffer();
    TextureHandle places, cells, mip, target;
    std::size_t bytes = 0;
    int width = 0, height = 0;
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
    std::vector<std::uint8_t> bytes(raster.rgba.size());
    glReadPixels(0, 0, view.width, view.height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    checkErrors("reading a pattern");
    std::ranges::transform(bytes, raster.rgba.begin(), [](std::uint8_t b) { return float(b) / 255; });
    return raster;
}

}  // namespace vtm::paper

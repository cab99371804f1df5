#include <vtm/gl/ids.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "backend_gl/core/placement.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/output/destination.hpp"
#include "backend_gl/sampled_data.hpp"
#include "backend_gl/upload/asset_texels.hpp"
#include "backend_gl/upload/upload.hpp"

namespace vtm::gl {

namespace {

using asset::Texel;
using glm::dvec2;

constexpr double unitsPerSide = double(1u << (2 * asset::maxLevel));

/// The map's place, picture units to units of id_fragment.glsl.
dvec2 toUnits(const asset::Map& map, dvec2 picture) {
    return (picture - dvec2(map.x, map.y)) / map.side * unitsPerSide;
}

void requireIntegers(GLuint framebuffer) {
    const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    GLint type = 0;
    const GLint buffer = limit(GL_DRAW_BUFFER0);
    if (status == GL_FRAMEBUFFER_COMPLETE && buffer != GL_NONE)
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GLenum(buffer),
                                              GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
    if (type != GL_UNSIGNED_INT)
        throw GlError(fmt::format("framebuffer {} does not have an unsigned integer format", framebuffer));
}

void requireIds(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint) {
    if (!asset::isSumOfMaps(asset) || idOfPaint.size() != asset.paints.size())
        throw std::invalid_argument("ids need an asset of exact mode and one id for each paint");
    if (!asset.instances.empty())
        throw std::invalid_argument("ids need an asset without instances: Options::instances = false");
}

asset::Map mapOf(const asset::AssetView& asset) {
    return asset.commands.empty() ? asset::Map{0, 0, 1, {}, 0} : asset.maps[asset.commands[0].map];
}

/// `sections`: paints are numbers, data are nodes.
std::vector<Texel> recordsOf(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint,
                             Sections& sections) {
    std::vector<Texel> numbers, texels;
    for (const std::uint32_t id : idOfPaint)
        numbers.push_back({id, 0, 0, 0});
    sections.leaves = appendTexels(texels, asset.leaves);
    sections.pieces = appendTexels(texels, asset.pieces);
    sections.paints = appendTexels<Texel>(texels, numbers);
    sections.data = appendTexels(texels, asset.nodes);
    return texels;
}

}  // namespace

struct IdTexture::Impl {
    asset::Map map;
    Sections sections;  ///< as recordsOf() sets them
    TextureHandle texels;
};

IdTexture::IdTexture(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
IdTexture::~IdTexture() = default;
IdTexture::IdTexture(IdTexture&&) noexcept = default;
IdTexture& IdTexture::operator=(IdTexture&&) noexcept = default;

struct IdRenderer::Impl {
    explicit Impl(StateContract c) : contract(std::move(c)) {}

    StateContract contract;
    Program program{idsSource()};
    VertexArrayHandle vertexArray = makeVertexArray();

    /// Into pixels [0, width) × [0, height) of the framebuffer that is bound.
    void draw(const IdTexture::Impl& texture, const asset::View& view) const {
        const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
        const dvec2 pixel = dvec2(view.width, view.height) * 0.5;
        const dvec2 centre = toUnits(texture.map, inverse * (pixel - view.toPixels[2]));
        // Only differences from a whole unit near the view are single.
        const dvec2 base = glm::clamp(glm::floor(centre), dvec2(0), dvec2(unitsPerSide)),
                    rest = centre - base;
        const glm::dmat2 linear = inverse * (unitsPerSide / texture.map.side);
        glViewport(0, 0, view.width, view.height);
        program.use();
        glBindVertexArray(vertexArray.get());
        glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Texels));
        glBindTexture(GL_TEXTURE_2D, texture.texels.get());
        const Sections& s = texture.sections;
        glUniform1i(program.uniform("texels"), int(Unit::Texels));
        glUniform4ui(program.uniform("sections"), s.leaves, s.pieces, s.paints, s.data);
        glUniform1ui(program.uniform("rootEntry"), texture.map.root.bits);
        glUniform4f(program.uniform("pixelToUnit"), float(linear[0].x), float(linear[0].y),
                    float(linear[1].x), float(linear[1].y));
        glUniform4f(program.uniform("unitAnchor"), float(rest.x), float(rest.y), float(pixel.x),
                    float(pixel.y));
        glUniform2i(program.uniform("baseUnit"), GLint(base.x), GLint(base.y));
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, view.width, view.height);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisable(GL_SCISSOR_TEST);
        checkErrors("drawing numbers");
    }
};

IdRenderer::IdRenderer() {
    requireContext();
    StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(contract);
}
IdRenderer::~IdRenderer() = default;

IdTexture IdRenderer::upload(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint) {
    requireIds(asset, idOfPaint);
    dropErrors();
    const StateGuard guard(impl_->contract, true, Touched::uploads());
    auto texture = std::make_unique<IdTexture::Impl>();
    texture->map = mapOf(asset);
    texture->texels = texelTexture(recordsOf(asset, idOfPaint, texture->sections));
    return IdTexture(std::move(texture));
}

std::vector<std::uint32_t> IdRenderer::render(const IdTexture& texture, const asset::View& view) {
    asset::validate(view);
    std::vector<std::uint32_t> ids(std::size_t(view.width) * std::size_t(view.height));
    if (ids.empty() || !isInvertible(view))
        return ids;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    const TextureHandle target = makeTexture(GL_R32UI, view.width, view.height);
    const FramebufferHandle framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
    impl_->draw(*texture.impl_, view);
    // Of integers only four channels can be read everywhere.
    std::vector<std::uint32_t> row(std::size_t(view.width) * 4);
    for (int y = 0; y < view.height; ++y) {
        glReadPixels(0, y, view.width, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, row.data());
        for (int x = 0; x < view.width; ++x)
            ids[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] = row[std::size_t(x) * 4];
    }
    checkErrors("reading numbers");
    return ids;
}

void IdRenderer::draw(const IdTexture& texture, const asset::View& view,
                      std::optional<unsigned> framebuffer) {
    asset::validate(view);
    if (view.width == 0 || view.height == 0 || !isInvertible(view))
        return;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    const GLuint into = framebuffer.value_or(guard.drawFramebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, into);
    requireIntegers(into);
    const OneDrawBuffer one;
    impl_->draw(*texture.impl_, view);
}

IdData idData(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint) {
    requireIds(asset, idOfPaint);
    const asset::Map map = mapOf(asset);
    const ProgramSource source = idsSource();
    Sections s;
    const std::vector<Texel> texels = recordsOf(asset, idOfPaint, s);
    using Words = std::vector<std::uint32_t>;
    return {
        joined(source.vertex),
        joined(source.fragment),
        {{texelData("texels", texels)},
         {{"sections", Words{s.leaves, s.pieces, s.paints, s.data}}, {"rootEntry", Words{map.root.bits}}}},
        {map.x, map.y, map.side},
        unitsPerSide};
}

}  // namespace vtm::gl

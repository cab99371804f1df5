#include "backend_gl/texture/vtm_uniform.hpp"

#include <bit>

#include <fmt/format.h>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/turns.hpp"
#include "backend_gl/texture/instance_grids.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;
using asset::Wrap;

/// Fills of materials name them by their key, since a program may know those of several assets.
std::vector<Texel> dataOf(const AssetView& asset) {
    std::vector<Texel> data(asset.data.begin(), asset.data.end());
    for (const asset::Paint& paint : asset.paints)
        for (std::uint32_t i = 0; asset::isProgram(paint) && i < paint[1]; ++i) {
            const auto in = std::bit_cast<asset::Instruction>(asset.data[paint[0] + i]);
            if (in.op == asset::Op::Material)
                data[in.argument + 1][2] = materialKey(asset.materials[asset.data[in.argument + 1][2]]);
        }
    return data;
}

/// Programs with their turns in the word that is free.
std::vector<asset::Paint> paintsOf(const AssetView& asset) {
    std::vector<asset::Paint> paints(asset.paints.begin(), asset.paints.end());
    const std::vector<std::uint32_t> turns = programTurns(asset, ImageTurns::CountedByShaders);
    for (std::size_t i = 0; i < paints.size(); ++i)
        if (asset::isProgram(paints[i]))
            paints[i][2] = turns[i];
    return paints;
}

/// Two texels a symbol: the record, with the map's index unused; then the map's root and its first grid.
std::vector<Texel> symbolsOf(const AssetView& asset, const std::vector<GLuint>& grids) {
    std::vector<Texel> texels;
    for (const asset::Symbol& symbol : asset.symbols) {
        const asset::Map& map = asset.maps[symbol.map];
        texels.push_back(std::bit_cast<Texel>(symbol));
        texels.push_back({map.root.bits, grids[symbol.map], 0, 0});
    }
    return texels;
}

}  // namespace

std::vector<Texel> recordTexels(const AssetView& asset, std::span<const Texel> imageList, Parts& parts) {
    std::vector<Texel> texels;
    const std::vector<Texel> data = dataOf(asset);
    parts.leaves = appendTexels(texels, asset.leaves);
    parts.pieces = appendTexels(texels, asset.pieces);
    parts.paints = appendTexels<asset::Paint>(texels, paintsOf(asset));
    parts.data = appendTexels<Texel>(texels, data);
    parts.images = appendTexels<Texel>(texels, imageList);
    parts.rampSums = appendTexels<Texel>(texels, rampSums(asset));
    // What changes when instances move stands last (SampledTexture::update).
    parts.palettes = appendTexels(texels, asset.palettes);
    parts.nodes = appendTexels(texels, asset.nodes);
    parts.instances = appendTexels(texels, asset.instances);
    const InstanceGrids grids = instanceGrids(asset, GLuint(texels.size()));
    parts.grid = asset.commands.empty() ? 0 : grids.ofMap[asset.commands[0].map];
    appendTexels<Texel>(texels, grids.texels);
    parts.symbols = appendTexels<Texel>(texels, symbolsOf(asset, grids.ofMap));
    return texels;
}

namespace {

GLint wrapMode(Wrap wrap) {
    return wrap == Wrap::Repeat ? GL_REPEAT : wrap == Wrap::Mirror ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE;
}

/// Trilinear. Beyond a border the shader itself makes it transparent.
SamplerHandle makeSampler(Wrapping wrapping) {
    GLuint id = 0;
    glGenSamplers(1, &id);
    SamplerHandle sampler(id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(id, GL_TEXTURE_WRAP_S, wrapMode(wrapping.s));
    glSamplerParameteri(id, GL_TEXTURE_WRAP_T, wrapMode(wrapping.t));
    return sampler;
}

}  // namespace

GLuint Samplers::of(Wrapping wrapping) {
    SamplerHandle& found = samplers_[unsigned(wrapping.s) * wrapCount + unsigned(wrapping.t)];
    if (found.get() == 0)
        found = makeSampler(wrapping);
    return found.get();
}

std::vector<UniformValue> VtmUniform::values(Wrapping wrapping) const {
    using Ints = std::vector<std::int32_t>;
    using Words = std::vector<std::uint32_t>;
    using Floats = std::vector<float>;
    return {{"sections", Words{parts.leaves, parts.pieces, parts.paints, parts.data}},
            {"imageSection", Words{parts.images}},
            {"rampSums", Words{parts.rampSums}},
            {"nodes", Words{parts.nodes}},
            {"root", Words{map.root.bits}},
            {"ground", Words{ground}},
            {"features", Words{flags}},
            {"size", Floats{float(width), float(height)}},
            {"square", Floats{float(map.x), float(map.y), float(map.side)}},
            {"prefilterTexels", Floats{float(prefilterSize.width), float(prefilterSize.height)}},
            {"wrapping", Ints{int(wrapping.s), int(wrapping.t)}},
            {"page", Words{page}},
            {"grid", Words{parts.grid}},
            {"placed", Words{parts.instances, parts.symbols, parts.palettes}}};
}

namespace {

/// A list of one number to four, by the function for so many.
template <class Numbers, class... Functions>
void setNumbers(GLint place, const Numbers& numbers, Functions... functions) {
    const std::array byCount{functions...};
    byCount[numbers.size() - 1](place, 1, numbers.data());
}

struct UniformSetter {
    GLint place;

    void operator()(const std::vector<GLint>& n) const {
        setNumbers(place, n, glUniform1iv, glUniform2iv, glUniform3iv, glUniform4iv);
    }
    void operator()(const std::vector<GLuint>& n) const {
        setNumbers(place, n, glUniform1uiv, glUniform2uiv, glUniform3uiv, glUniform4uiv);
    }
    void operator()(const std::vector<GLfloat>& n) const {
        setNumbers(place, n, glUniform1fv, glUniform2fv, glUniform3fv, glUniform4fv);
    }
};

}  // namespace

void VtmUniform::set(GLuint program, const std::string& name, Wrapping wrapping) const {
    for (const UniformValue& value : values(wrapping))
        std::visit(UniformSetter{glGetUniformLocation(program, (name + '.' + value.name).c_str())},
                   value.numbers);
}

Binding::Binding(GLuint program, const std::string& name, unsigned firstUnit, unsigned units)
    : savedProgram_(limit(GL_CURRENT_PROGRAM)),
      savedUnit_(limit(GL_ACTIVE_TEXTURE)),
      program_(program),
      name_(name),
      firstUnit_(firstUnit) {
    checkErrors("something before a texture was bound");
    const unsigned maximum = unsigned(limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
    if (firstUnit + units > maximum || firstUnit > maximum)
        throw GlError(fmt::format("'{}' needs texture units {} to {}: the driver has {}", name, firstUnit,
                                  firstUnit + units - 1, maximum));
    if (glGetUniformLocation(program, (name + ".texels").c_str()) < 0)
        throw GlError(fmt::format("program {} has no 'uniform Vtm {}', or does not use it", program, name));
    glUseProgram(program);
}

Binding::~Binding() {
    // One that was deleted while it was current is gone once another is.
    glUseProgram(glIsProgram(GLuint(savedProgram_)) ? GLuint(savedProgram_) : 0);
    glActiveTexture(GLenum(savedUnit_));
}

void Binding::texture(const char* member, unsigned unit, GLuint texture, GLuint sampler) const {
    unused(member, unit);
    glActiveTexture(GL_TEXTURE0 + firstUnit_ + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glBindSampler(firstUnit_ + unit, sampler);
}

void Binding::unused(const char* member, unsigned unit) const {
    glUniform1i(glGetUniformLocation(program_, (name_ + '.' + member).c_str()), GLint(firstUnit_ + unit));
}

}  // namespace vtm::gl

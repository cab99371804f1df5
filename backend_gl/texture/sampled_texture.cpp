#include <vtm/gl/sampled_texture.hpp>

#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/features.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/requirements.hpp"
#include "backend_gl/core/state_guard.hpp"
#include "backend_gl/core/turns.hpp"
#include "backend_gl/texture/sample_include.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;
using asset::Wrap;

/// First texels of the parts of the one texture that holds all records.
struct Parts {
    GLuint nodes = 0, leaves = 0, pieces = 0, paints = 0, data = 0, images = 0, rampSums = 0;
    GLuint instanceTrees = 0, instances = 0, symbols = 0, palettes = 0;
};

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

/// Two texels a symbol: the record, with the map's index unused; then the map's root and its first tree.
std::vector<Texel> symbolsOf(const AssetView& asset) {
    std::vector<Texel> texels;
    for (const asset::Symbol& symbol : asset.symbols) {
        const asset::Map& map = asset.maps[symbol.map];
        texels.push_back(std::bit_cast<Texel>(symbol));
        texels.push_back({map.root.bits, map.instances, 0, 0});
    }
    return texels;
}

/// Eight numbers a texel.
std::vector<Texel> palettesOf(const AssetView& asset) {
    constexpr std::size_t perTexel = sizeof(Texel) / sizeof(std::uint16_t);
    std::vector<Texel> texels((asset.palettes.size() + perTexel - 1) / perTexel);
    if (!texels.empty())
        std::memcpy(static_cast<void*>(texels.data()), asset.palettes.data(), asset.palettes.size_bytes());
    return texels;
}

std::vector<Texel> joined(const AssetView& asset, std::span<const Texel> imageList, Parts& parts) {
    std::vector<Texel> texels;
    const std::vector<Texel> data = dataOf(asset);
    parts.nodes = appendTexels(texels, asset.nodes);
    parts.leaves = appendTexels(texels, asset.leaves);
    parts.pieces = appendTexels(texels, asset.pieces);
    parts.paints = appendTexels<asset::Paint>(texels, paintsOf(asset));
    parts.data = appendTexels<Texel>(texels, data);
    parts.images = appendTexels<Texel>(texels, imageList);
    parts.rampSums = appendTexels<Texel>(texels, rampSums(asset));
    parts.instanceTrees = appendTexels(texels, asset.instanceTrees);
    parts.instances = appendTexels(texels, asset.instances);
    parts.symbols = appendTexels<Texel>(texels, symbolsOf(asset));
    parts.palettes = appendTexels<Texel>(texels, palettesOf(asset));
    return texels;
}

TextureHandle uploadPrefilter(const asset::PrefilterView& prefilter) {
    const asset::PyramidSize& size = prefilter.size;
    const int largest = limit(GL_MAX_TEXTURE_SIZE);
    if (int(size.width) > largest || int(size.height) > largest)
        throw GlError(fmt::format("prefilter of {} x {} texels: the driver's limit is {} per side",
                                  size.width, size.height, largest));
    GLuint id = 0;
    glGenTextures(1, &id);
    TextureHandle texture(id);
    glBindTexture(GL_TEXTURE_2D, id);
    glTexStorage2D(GL_TEXTURE_2D, GLsizei(size.levels()), GL_RGBA8, GLsizei(size.width),
                   GLsizei(size.height));
    for (unsigned l = 0; l < size.levels(); ++l) {
        const asset::PyramidSize level = size.level(l);
        glTexSubImage2D(GL_TEXTURE_2D, GLint(l), 0, 0, GLsizei(level.width), GLsizei(level.height), GL_RGBA,
                        GL_UNSIGNED_BYTE, prefilter.texels.data() + size.texelsBefore(l));
    }
    checkErrors("upload of a prefilter");
    return texture;
}

GLint wrapMode(Wrap wrap) {
    return wrap == Wrap::Repeat ? GL_REPEAT : wrap == Wrap::Mirror ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE;
}

/// What binding to a program changes on the way, as it was: the current program and the active unit.
class SavedBindState {
public:
    SavedBindState() : program_(limit(GL_CURRENT_PROGRAM)), unit_(limit(GL_ACTIVE_TEXTURE)) {}
    ~SavedBindState() {
        // One that was deleted while it was current is gone once another is.
        glUseProgram(glIsProgram(GLuint(program_)) ? GLuint(program_) : 0);
        glActiveTexture(GLenum(unit_));
    }
    SavedBindState(const SavedBindState&) = delete;
    SavedBindState& operator=(const SavedBindState&) = delete;

private:
    GLint program_, unit_;
};

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

constexpr unsigned wrapCount = 4;

const asset::Map& onlyMap(const AssetView& asset) {
    if (asset.mode != asset::Mode::Exact)
        throw GlError("an asset of compat mode cannot be sampled: it has layers, not regions");
    if (asset.commands.size() != 1 || asset.commands[0].kind != asset::Command::Kind::DrawMap)
        throw GlError("only an asset that draws one map can be sampled");
    return asset.maps[asset.commands[0].map];
}

}  // namespace

struct SampledTexture::Impl {
    Impl(const AssetView& asset, const asset::PrefilterView& pyramid)
        : Impl(asset, pyramid, imageTexels(asset)) {}
    Impl(const AssetView& asset, const asset::PrefilterView& pyramid, ImageTexels pictures)
        : width(asset.width),
          height(asset.height),
          finestPixel(asset.finestPixel),
          map(onlyMap(asset)),
          features(featuresOf(asset)),
          flags(samplingFlags(features, innerMapsOf(asset))),
          prefilterSize(pyramid.size),
          texels(texelTexture(joined(asset, pictures.list, parts))),
          prefilter(uploadPrefilter(pyramid)),
          images(features.has(Features::Image) ? imageTexture(std::move(pictures.rgba)) : TextureHandle()) {}

    double width, height;
    std::optional<double> finestPixel;
    asset::Map map;
    Features features;
    std::uint32_t flags;
    asset::PyramidSize prefilterSize;
    Parts parts;  // before `texels`, which sets it
    TextureHandle texels, prefilter, images;
    std::array<SamplerHandle, wrapCount * wrapCount> samplers;  ///< made when first needed

    const SamplerHandle& sampler(Wrapping wrapping) {
        SamplerHandle& found = samplers[unsigned(wrapping.s) * wrapCount + unsigned(wrapping.t)];
        if (found.get() == 0)
            found = makeSampler(wrapping);
        return found;
    }

    void setUniforms(GLuint program, const std::string& name, Wrapping wrapping) const {
        const auto at = [&](const char* member) {
            return glGetUniformLocation(program, (name + '.' + member).c_str());
        };
        glUniform4ui(at("sections"), parts.leaves, parts.pieces, parts.paints, parts.data);
        glUniform1ui(at("imageSection"), parts.images);
        glUniform1ui(at("rampSums"), parts.rampSums);
        glUniform1ui(at("nodes"), parts.nodes);
        glUniform1ui(at("root"), map.root.bits);
        glUniform1ui(at("features"), flags);
        glUniform2f(at("size"), float(width), float(height));
        glUniform3f(at("square"), float(map.x), float(map.y), float(map.side));
        glUniform2f(at("prefilterTexels"), float(prefilterSize.width), float(prefilterSize.height));
        glUniform2i(at("wrapping"), int(wrapping.s), int(wrapping.t));
        glUniform1ui(at("instances"), map.instances);
        glUniform4ui(at("placed"), parts.instanceTrees, parts.instances, parts.symbols, parts.palettes);
    }

    static void bindUnit(GLuint program, const std::string& uniform, GLuint unit, GLuint texture,
                         GLuint sampler) {
        glUniform1i(glGetUniformLocation(program, uniform.c_str()), GLint(unit));
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, texture);
        glBindSampler(unit, sampler);
    }
};

SampledTexture::SampledTexture(const AssetView& asset, const asset::PrefilterOptions& options) {
    onlyMap(asset);
    requireCurrentContext();
    asset::Prefilter made;
    asset::PrefilterView pyramid = asset.prefilter;
    if (pyramid.size.empty()) {
        made = asset::buildPrefilter(asset, options);
        pyramid = {made.size, made.texels};
    }
    checkErrors("something before this texture was made");
    const StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(asset, pyramid);
}
SampledTexture::~SampledTexture() = default;
SampledTexture::SampledTexture(SampledTexture&&) noexcept = default;
SampledTexture& SampledTexture::operator=(SampledTexture&&) noexcept = default;

std::optional<double> SampledTexture::finestPixel() const { return impl_->finestPixel; }

unsigned SampledTexture::units() const { return impl_->images.get() != 0 ? 3 : 2; }

void SampledTexture::bind(unsigned program, const std::string& name, unsigned firstUnit, Wrapping wrapping) {
    checkErrors("something before a texture was bound");
    const unsigned maximum = unsigned(limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
    if (firstUnit + units() > maximum || firstUnit > maximum)
        throw GlError(fmt::format("'{}' needs texture units {} to {}: the driver has {}", name, firstUnit,
                                  firstUnit + units() - 1, maximum));
    if (glGetUniformLocation(program, (name + ".texels").c_str()) < 0)
        throw GlError(fmt::format("program {} has no 'uniform Vtm {}', or does not use it", program, name));
    const SavedBindState saved;
    glUseProgram(program);
    impl_->setUniforms(program, name, wrapping);
    const GLuint sampler = impl_->sampler(wrapping).get();
    Impl::bindUnit(program, name + ".texels", firstUnit, impl_->texels.get(), 0);
    Impl::bindUnit(program, name + ".prefilter", firstUnit + 1, impl_->prefilter.get(), sampler);
    if (impl_->images.get() != 0)
        Impl::bindUnit(program, name + ".images", firstUnit + 2, impl_->images.get(), 0);
    else  // a program for others with images wants a unit that holds the right kind of texture
        glUniform1i(glGetUniformLocation(program, (name + ".images").c_str()), GLint(firstUnit + 1));
    checkErrors("binding a texture");
}

}  // namespace vtm::gl

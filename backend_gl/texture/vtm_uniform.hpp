/// \file
/// `uniform Vtm`: records and prefilter on the GPU, and what a program is told of them. Behind SampledTexture
/// and TextTexture.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vtm/gl/sampled_texture.hpp>
#include "backend_gl/core/gl.hpp"
#include "backend_gl/sampled_data.hpp"

namespace vtm::gl {

/// First texels of the parts of the one texture that holds all records.
struct Parts {
    GLuint nodes = 0, leaves = 0, pieces = 0, paints = 0, data = 0, images = 0, rampSums = 0;
    GLuint instances = 0, symbols = 0, palettes = 0;
    GLuint grid = 0;  ///< first of the map that the asset draws; 0: it has no instances
};

/// The asset's records, and where each part of them begins.
std::vector<asset::Texel> recordTexels(const asset::AssetView& asset, std::span<const asset::Texel> imageList,
                                       Parts& parts);

/// The members of a Vtm that are no textures.
struct VtmUniform {
    Parts parts;
    double width = 0, height = 0;
    asset::Map map;            ///< that is sampled
    std::uint32_t ground = 0;  ///< solid paint that most of its squares show
    std::uint32_t flags = 0;   ///< samplingFlags
    asset::PyramidSize prefilterSize;
    GLuint page = 0;  ///< first texel of a page of text; 0: none

    std::vector<UniformValue> values(Wrapping wrapping) const;
    /// Of the current program.
    void set(GLuint program, const std::string& name, Wrapping wrapping) const;
};

/// Trilinear samplers, made when they are first needed. Beyond a border the shader itself makes it
/// transparent.
class Samplers {
public:
    GLuint of(Wrapping wrapping);

private:
    static constexpr unsigned wrapCount = 4;
    std::array<SamplerHandle, wrapCount * wrapCount> samplers_;
};

/// Binds to a program: textures to units from the first on. The current program and the active unit are as
/// they were once it is gone.
class Binding {
public:
    /// Throws GlError if the program has no `uniform Vtm NAME`, or the driver has not so many units.
    Binding(GLuint program, const std::string& name, unsigned firstUnit, unsigned units);
    ~Binding();
    Binding(const Binding&) = delete;
    Binding& operator=(const Binding&) = delete;

    void texture(const char* member, unsigned unit, GLuint texture, GLuint sampler) const;
    /// A sampler that the program has and this asset does not need: it wants a unit with the right kind of
    /// texture.
    void unused(const char* member, unsigned unit) const;

private:
    GLint savedProgram_, savedUnit_;
    GLuint program_;
    std::string name_;
    unsigned firstUnit_;
};

}  // namespace vtm::gl

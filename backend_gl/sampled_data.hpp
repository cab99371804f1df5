/// \file
/// What SampledTexture and IdRenderer give to GL, as data: for another binding of it, WebGL's, to upload,
/// compile and set.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/sampled_texture.hpp>

namespace vtm::gl {

/// What glUniform is called with: one number to four of one type.
struct UniformValue {
    std::string name;
    std::variant<std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<float>> numbers;
};

/// A 2D texture for the sampler uniform `name`.
struct TextureData {
    enum class Format { Rgba32ui, Rgba8 };

    std::string name;
    Format format = Format::Rgba8;
    unsigned width = 0, height = 0;
    unsigned levels = 1;              ///< as those of glTexStorage2D
    bool isFiltered = false;          ///< trilinear, clamped to the edge; else it is only fetched from
    std::vector<std::uint8_t> bytes;  ///< of all levels, finest first, rows as glTexSubImage2D takes them
};

/// A program's inputs. Names of a Vtm's members are those within it.
struct ShaderData {
    std::vector<TextureData> textures;
    std::vector<UniformValue> uniforms;
};

/// `uniform Vtm` with transparent borders. Throws GlError for an asset that cannot be sampled. Without a
/// prefilter one is built.
ShaderData sampledData(const asset::AssetView& asset, const asset::PrefilterOptions& options = {});

/// IdRenderer's program and its inputs, except for the uniforms of the view: `baseUnit`, `unitAnchor` and
/// `pixelToUnit` of id_fragment.glsl.
struct IdData {
    std::string vertex, fragment;
    ShaderData data;
    std::array<double, 3> square;  ///< the map's: least x and y, side
    double unitsPerSide = 0;       ///< of that square
};
/// Throws as IdRenderer::upload does.
IdData idData(const asset::AssetView& asset, std::span<const std::uint32_t> idOfPaint);

}  // namespace vtm::gl

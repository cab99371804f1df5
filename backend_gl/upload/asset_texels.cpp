#include "backend_gl/upload/asset_texels.hpp"

#include <algorithm>
#include <limits>

#include "backend_gl/core/constants.hpp"
#include "image/levels.hpp"

namespace vtm::gl {

namespace {

/// `items` grows to whole rows.
template <class Items>
TextureHandle layOut(Items items, std::size_t itemsPerTexel, unsigned columnsLog2, GLenum format,
                     GLenum layout, GLenum type) {
    const std::size_t columns = std::size_t(1) << columnsLog2;
    const std::size_t texels = std::max<std::size_t>(items.size() / itemsPerTexel, 1);
    const std::size_t rows = (texels + columns - 1) / columns;
    if (rows > std::size_t(std::numeric_limits<GLsizei>::max()))
        throw GlError("the asset is too large for a texture");
    TextureHandle texture = makeTexture(format, int(columns), int(rows));
    items.resize(rows * columns * itemsPerTexel);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(columns), GLsizei(rows), layout, type, items.data());
    checkErrors("upload");
    return texture;
}

}  // namespace

ImageTexels imageTexels(const asset::AssetView& asset) {
    const std::vector<bool> withLevels = asset::imagesWithLevels(asset);
    ImageTexels texels;
    const auto append = [&](std::span<const std::uint8_t> rgba) {
        texels.rgba.insert(texels.rgba.end(), rgba.begin(), rgba.end());
    };
    for (std::size_t i = 0; i < asset.images.size(); ++i) {
        const image::Bitmap& bitmap = asset.images[i];
        texels.list.push_back({std::uint32_t(texels.rgba.size() / 4), std::uint32_t(bitmap.width),
                               std::uint32_t(bitmap.height), 0});
        append(bitmap.rgba);
        if (withLevels[i])
            for (const image::Level& level : image::levelsOf(bitmap))
                append(level.rgba);
    }
    return texels;
}

TextureHandle texelTexture(std::vector<asset::Texel> texels) {
    return layOut(std::move(texels), 1, texelColumnsLog2, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
}

TextureHandle imageTexture(std::vector<std::uint8_t> rgba) {
    return layOut(std::move(rgba), 4, imageColumnsLog2, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
}

}  // namespace vtm::gl

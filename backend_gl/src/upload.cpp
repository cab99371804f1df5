#include "backend_gl/src/upload.hpp"

#include <algorithm>
#include <limits>

#include "backend_gl/src/constants.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Texel;

constexpr std::uint32_t mapsPerRow = placementColumns * sizeof(Texel) / sizeof(Placement);

std::vector<Texel> imageList(const AssetView& asset) {
    std::vector<Texel> list;
    std::uint32_t pixels = 0;
    for (const image::Bitmap& bitmap : asset.images) {
        list.push_back({pixels, std::uint32_t(bitmap.width), std::uint32_t(bitmap.height), 0});
        pixels += std::uint32_t(bitmap.rgba.size() / 4);
    }
    return list;
}

/// The trees themselves stay behind: instances stand for them.
std::vector<Texel> joinedTexels(const AssetView& asset, Sections& sections) {
    std::vector<Texel> texels;
    sections.leaves = append(texels, asset.leaves);
    sections.pieces = append(texels, asset.pieces);
    sections.paints = append(texels, asset.paints);
    sections.data = append(texels, asset.data);
    sections.images = append<Texel>(texels, imageList(asset));
    return texels;
}

/// Lays items row after row into a texture `1 << columnsLog2` wide; `bytes` grows to whole rows.
template <class Items>
TextureHandle layOut(Items& items, std::size_t itemsPerTexel, unsigned columnsLog2, GLenum format,
                     GLenum layout, GLenum type) {
    const std::size_t columns = std::size_t(1) << columnsLog2;
    const std::size_t texels = std::max<std::size_t>(items.size() / itemsPerTexel, 1);
    const std::size_t rows = (texels + columns - 1) / columns;
    if (rows > std::size_t(std::numeric_limits<GLsizei>::max()))
        throw GlError("asset too large for a texture");
    TextureHandle texture = makeTexture(format, int(columns), int(rows));
    items.resize(rows * columns * itemsPerTexel);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(columns), GLsizei(rows), layout, type, items.data());
    checkErrors("upload");
    return texture;
}

TextureHandle uploadImages(const AssetView& asset) {
    std::vector<std::uint8_t> pixels;
    for (const image::Bitmap& bitmap : asset.images)
        pixels.insert(pixels.end(), bitmap.rgba.begin(), bitmap.rgba.end());
    return layOut(pixels, 4, imageColumnsLog2, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
}

BufferHandle uploadInstances(const std::vector<Instance>& instances) {
    BufferHandle buffer = makeBuffer();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(instances.size() * sizeof(Instance)), instances.data(),
                 GL_STATIC_DRAW);
    checkErrors("instances");
    return buffer;
}

}  // namespace

TextureHandle uploadTexels(std::vector<Texel>& texels) {
    return layOut(texels, 1, texelColumnsLog2, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
}

UploadedAsset::UploadedAsset(const AssetView& asset, unsigned materials)
    : maps(asset.maps.begin(), asset.maps.end()),
      commands(asset.commands.begin(), asset.commands.end()),
      list(isSumOfMaps(asset) ? InstanceList{} : makeInstances(asset)),
      features(featuresOf(asset)),
      materialSet(materials),
      paints(asset.paints.begin(), asset.paints.end()) {
    if (isSumOfMaps(asset))
        for (const asset::Command& command : asset.commands)
            atlases.emplace_back(asset, asset.maps[command.map]);
    for (const asset::Paint& paint : asset.paints)
        isProgram.push_back(paint[3] == asset::programTag);
    std::vector<Texel> joined = joinedTexels(asset, sections);
    texels = uploadTexels(joined);
    images = uploadImages(asset);
    instances = uploadInstances(list.instances);
    list.instances = {};
    placements.resize((maps.size() / mapsPerRow + 1) * mapsPerRow);
    placementTexels = makeTexture(GL_RGBA32F, placementColumns, int(placements.size() / mapsPerRow));
}

void UploadedAsset::uploadPlacements(std::uint32_t first, std::uint32_t last) {
    const std::uint32_t firstRow = first / mapsPerRow, rows = last / mapsPerRow - firstRow + 1;
    glBindTexture(GL_TEXTURE_2D, placementTexels.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, GLint(firstRow), placementColumns, GLsizei(rows), GL_RGBA, GL_FLOAT,
                    &placements[firstRow * mapsPerRow]);
}

Texture::Texture(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;

}  // namespace vtm::gl

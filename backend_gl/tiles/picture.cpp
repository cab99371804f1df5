#include "backend_gl/tiles/picture.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "backend_gl/tiles/blocks.hpp"
#include "gles_context/renderer_name.hpp"

namespace vtm::gl {

namespace {

using glm::dvec2;

void pointFloats(GLuint index, GLint count, std::size_t stride, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, GLsizei(stride),
                          reinterpret_cast<const void*>(offset));
}

void pointWords(GLuint index, GLint count, std::size_t stride, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribIPointer(index, count, GL_UNSIGNED_INT, GLsizei(stride),
                           reinterpret_cast<const void*>(offset));
}

/// By name: what no name tells is not timed for this.
bool isSoftwareByName() {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name != nullptr && gles_context::isSoftwareName(name).value_or(false);
}

/// What a box will show when the picture is so much larger about the same middle.
PixelBox boxAhead(const PixelBox& box, double scale) {
    const dvec2 middle = 0.5 * dvec2(box.min + box.max), reach = 0.5 * dvec2(box.size()) / scale;
    return {glm::ivec2(glm::floor(middle - reach)), glm::ivec2(glm::ceil(middle + reach))};
}

Blocks preparedBlocks(const UploadedAsset& asset, Atlas& atlas, const TileRaster& raster,
                      std::size_t fewest) {
    const std::vector<const Atlas::Placed*> tiles = atlas.prepare(raster.region());
    Blocks blocks =
        merged(blocksOf(raster, atlas, std::span(asset.paints).subspan(atlas.firstPaint()), tiles), fewest);
    if (const std::optional<Atlas::Zoom> zoom = atlas.zoomTo(raster.view()))
        atlas.prepareAhead(TileRaster(atlas.map(), raster.view(), boxAhead(raster.box(), zoom->scale),
                                      raster.region().level + zoom->levels, raster.grid().side)
                               .region());
    return blocks;
}

template <class Vertex>
void draw(GLenum primitive, const VertexArrayHandle& array, const BufferHandle& buffer,
          const std::vector<Vertex>& vertices) {
    glBindVertexArray(array.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(),
                 GL_STREAM_DRAW);
    glDrawArrays(primitive, 0, GLsizei(vertices.size()));
}

void setMatrix(GLint uniform, const glm::dmat2& m) {
    glUniform4f(uniform, float(m[0].x), float(m[0].y), float(m[1].x), float(m[1].y));
}

void use(const Program& program, const Sections& s, std::uint32_t firstPaint, const TileRaster& raster) {
    const asset::View& view = raster.view();
    const double side = raster.side();
    const glm::dmat2 toPixels(view.toPixels[0] * side, view.toPixels[1] * side);
    program.use();
    glUniform2f(program.uniform("targetSize"), float(view.width), float(view.height));
    glUniform1f(program.uniform("blockSide"), float(raster.grid().side));
    glUniform4ui(program.uniform("sections"), s.leaves, s.pieces, s.paints + firstPaint, s.data);
    glUniform1ui(program.uniform("imageSection"), s.images);
    glUniform1ui(program.uniform("rampSums"), s.rampSums);
    const bool mirrored = glm::determinant(toPixels) < 0;
    setMatrix(program.uniform("toBox"), mirrored ? glm::dmat2(-1, 0, 0, 1) * toPixels : toPixels);
    setMatrix(program.uniform("toTile"), raster.pixelsToTiles());
    glUniform1f(program.uniform("sideOfTile"), float(side));
    glUniform1f(program.uniform("minSteepness"), raster.minSteepness());
}

void bindTexture(Unit unit, const TextureHandle& texture) {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, texture.get());
}

}  // namespace

PictureBuffers::PictureBuffers()
    : flatArray(makeVertexArray()),
      blockArray(makeVertexArray()),
      flat(makeBuffer()),
      block(makeBuffer()),
      costs(isSoftwareByName() ? onCpu : onGpu) {
    glBindVertexArray(flatArray.get());
    glBindBuffer(GL_ARRAY_BUFFER, flat.get());
    pointFloats(0, 2, sizeof(FlatVertex), offsetof(FlatVertex, position));
    pointFloats(1, 4, sizeof(FlatVertex), offsetof(FlatVertex, color));
    glBindVertexArray(blockArray.get());
    glBindBuffer(GL_ARRAY_BUFFER, block.get());
    pointFloats(0, 2, sizeof(BlockVertex), offsetof(BlockVertex, middle));
    pointFloats(1, 4, sizeof(BlockVertex), offsetof(BlockVertex, corner));
    pointWords(2, 4, sizeof(BlockVertex), offsetof(BlockVertex, texels));
    pointWords(3, 4, sizeof(BlockVertex), offsetof(BlockVertex, cells));
    pointWords(4, 4, sizeof(BlockVertex), offsetof(BlockVertex, more));
    glBindVertexArray(0);
}

namespace {

const Program& programOf(Programs& programs, const UploadedAsset& asset, const BlockWork& work,
                         Finish finish) {
    using Kind = BlockWork::Kind;
    const bool isBent = rampPoints[work.points].count > 1;
    switch (work.kind) {
        case Kind::Programs:
            return programs.tile(asset.features, asset.materialSet, finish, work.crowded);
        case Kind::Plain:
            return programs.plainTile(asset.features, isBent, finish, work.crowded);
        case Kind::OnePlain:
            return programs.plainFlat(asset.features, isBent, finish);
        default:
            return work.crowded ? programs.tile({}, 0, finish, true)
                                : programs.solidTile(work.hasTwoColors, work.isLong, finish);
    }
}

}  // namespace

PixelBox drawMap(Programs& programs, PictureBuffers& buffers, const UploadedAsset& asset, Atlas& atlas,
                 const asset::View& view, const PixelBox& box, Finish finish, bool markOverruns) {
    const bool scanned = atlas.isScanned(view);
    const TileRaster raster(atlas.map(), view, box, scanned ? 0 : tileLevelFor(atlas.map(), view),
                            buffers.costs.largestBlock);
    const Blocks blocks =
        scanned ? crowdedBlocks(raster, atlas) : preparedBlocks(asset, atlas, raster, buffers.costs.fewest);
    if (!blocks.crowded.empty()) {
        const bool light = finish.has(Finish::LinearLight);
        atlas.scanned().scan(view, blocks.crowded, box, raster.grid(),
                             light ? asset::Sums::Light : asset::Sums::Encoded);
        bindTexture(Unit::Layer, atlas.scanned().texture());
    }
    bindTexture(Unit::Texels, asset.records.texture());
    bindTexture(Unit::Images, asset.images);
    bindTexture(Unit::Tiles, atlas.texture());
    if (!blocks.flat.empty()) {
        use(programs.flat(finish), asset.sections, atlas.firstPaint(), raster);
        draw(GL_TRIANGLES, buffers.flatArray, buffers.flat, blocks.flat);
    }
    for (const BlockGroup& group : blocks.groups) {
        const Program& program = programOf(programs, asset, group.work, finish);
        use(program, asset.sections, atlas.firstPaint(), raster);
        glUniform1ui(program.uniform("rampPoints"), rampPoints[group.work.points].count);
        glUniform1i(program.uniform("markOverruns"), markOverruns);
        draw(GL_POINTS, buffers.blockArray, buffers.block, group.vertices);
    }
    return blocks.drawn;
}

void drawPicture(Programs& programs, PictureBuffers& buffers, UploadedAsset& asset, const asset::View& view,
                 const PixelBox& box, Finish finish, bool markOverruns) {
    // The first map stands on what is there, the others add to it.
    for (Atlas& atlas : asset.atlases) {
        if (&atlas != &asset.atlases.front()) {
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
        }
        drawMap(programs, buffers, asset, atlas, view, box, finish, markOverruns);
    }
    if (asset.atlases.size() > 1)
        glDisable(GL_BLEND);
}

}  // namespace vtm::gl

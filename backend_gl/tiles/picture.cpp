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

#include "raster/steepness.hpp"

namespace vtm::gl {

namespace {

using glm::dvec2;
using glm::i64vec2;
using Placed = Atlas::Placed;

/// Of flat_vertex.glsl.
struct FlatVertex {
    float position[2];
    float color[4];
};

/// Of tile_vertex.glsl.
struct TileVertex {
    float position[2];
    float origin[2];
    std::uint32_t texels[3];
    float picture[4];
    asset::Texel pair;
};

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

/// Squares of one cut under one view, those that a box of pixels can meet.
class Squares {
public:
    Squares(const asset::Map& map, const asset::View& view, const PixelBox& box, int level)
        : side_(std::ldexp(map.side, -level)), corner_(map.x, map.y), view_(view), box_(box) {
        const glm::dmat2 inverse = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
        minSteepness_ = asset::minSteepness(inverse);
        dvec2 minimum(HUGE_VAL), maximum(-HUGE_VAL);
        for (const dvec2 pixel :
             {dvec2(box.min), dvec2(box.max.x, box.min.y), dvec2(box.min.x, box.max.y), dvec2(box.max)}) {
            const dvec2 p = (inverse * (pixel - view.toPixels[2]) - corner_) / side_;
            minimum = glm::min(minimum, p);
            maximum = glm::max(maximum, p);
        }
        // The map's border belongs to pixels with centres up to a margin outside.
        const double end = std::ceil(std::ldexp(1.0, level)) + 1;
        min = i64vec2(glm::clamp(glm::floor(minimum), -1.0, end));
        max = i64vec2(glm::clamp(glm::floor(maximum) + 1.0, -1.0, end));
    }

    dvec2 picture(std::int64_t x, std::int64_t y) const { return corner_ + dvec2(x, y) * side_; }
    dvec2 pixel(std::int64_t x, std::int64_t y) const {
        return view_.toPixels * glm::dvec3(picture(x, y), 1);
    }
    double side() const { return side_; }
    float minSteepness() const { return minSteepness_; }

    /// Whether a square can show.
    bool visible(i64vec2 at) const {
        const auto [minimum, maximum] = bounds(dvec2(at), 1);
        return maximum.x > box_.min.x && maximum.y > box_.min.y && minimum.x < box_.max.x &&
               minimum.y < box_.max.y;
    }

    /// Pixels of the box that a square's cell can show in.
    PixelBox pixelsOfCell(i64vec2 at, const CellGrid& grid, int cell) const {
        const dvec2 place(cell % grid.cellsPerSide(), cell / grid.cellsPerSide());
        return pixelsOf(dvec2(at) + place * grid.cellSize(), grid.cellSize());
    }
    /// ... and a square.
    PixelBox pixelsOf(i64vec2 at) const { return pixelsOf(dvec2(at), 1); }

    i64vec2 min, max;

private:
    PixelBox pixelsOf(dvec2 corner, double side) const {
        const auto [minimum, maximum] = bounds(corner, side);
        const dvec2 first(box_.min), end(box_.max);
        return {glm::ivec2(glm::clamp(glm::floor(minimum), first, end)),
                glm::ivec2(glm::clamp(glm::ceil(maximum), first, end))};
    }

    /// The least and the largest pixel coordinates of a square, whose corner and side are in tiles.
    std::pair<dvec2, dvec2> bounds(dvec2 corner, double side) const {
        dvec2 minimum(HUGE_VAL), maximum(-HUGE_VAL);
        for (const dvec2 to : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}) {
            const dvec2 p = view_.toPixels * glm::dvec3(corner_ + (corner + to * side) * side_, 1);
            minimum = glm::min(minimum, p);
            maximum = glm::max(maximum, p);
        }
        return {minimum, maximum};
    }

    double side_;
    dvec2 corner_;
    const asset::View& view_;
    PixelBox box_;
    float minSteepness_;
};

/// Two triangles; where(corner) is a pixel.
template <class Vertex, class Where>
void addTriangles(std::vector<Vertex>& vertices, Vertex vertex, Where&& where) {
    for (const i64vec2 corner :
         {i64vec2(0, 0), i64vec2(1, 0), i64vec2(0, 1), i64vec2(0, 1), i64vec2(1, 0), i64vec2(1, 1)}) {
        const dvec2 pixel = where(corner);
        vertex.position[0] = float(pixel.x);
        vertex.position[1] = float(pixel.y);
        vertices.push_back(vertex);
    }
}

template <class Vertex>
void addSquare(std::vector<Vertex>& vertices, const Squares& squares, i64vec2 at, const Vertex& vertex) {
    addTriangles(vertices, vertex, [&](i64vec2 c) { return squares.pixel(at.x + c.x, at.y + c.y); });
}

struct Geometry {
    std::vector<FlatVertex> flat;
    std::vector<TileVertex> twoColors, solid, programs;
    struct Plain {
        std::vector<TileVertex> flat, others;
    };
    std::array<Plain, rampPoints.size()> plain;  ///< beside rampPoints
    PixelBox crowded;                            ///< holds the pixels of crowded cells
    PixelBox drawn;                              ///< holds what may not be transparent

    /// `minSteepness`: from which on paints are steep.
    std::vector<TileVertex>& of(const Placed& tile, float minSteepness) {
        if (tile.paints == TilePaints::Solid)
            return solid;
        if (tile.paints == TilePaints::Any || (!tile.flat && tile.steepness > minSteepness))
            return programs;
        Plain& tiles = plain[std::size_t(tile.paints) - std::size_t(TilePaints::Plain)];
        return tile.flat ? tiles.flat : tiles.others;
    }
};

FlatVertex flatVertex(const asset::Paint& paint, const PaintWords& words) {
    FlatVertex vertex{};
    for (unsigned c = 0; c < 4; ++c)
        vertex.color[c] = asset::isProgram(paint) ? float(words[c / 2] >> c % 2 * 16 & 0xFFFF) / 65535
                                                  : std::bit_cast<float>(paint[c]);
    return vertex;
}

TileVertex tileVertex(const Squares& squares, const Placed& tile, std::int64_t x, std::int64_t y) {
    const dvec2 origin = squares.pixel(x, y), picture = squares.picture(x, y);
    const std::uint32_t cells = tile.firstCell | tile.grid.log2 << gridShift;
    return {{0, 0},
            {float(origin.x), float(origin.y)},
            {tile.firstTexel, tile.flat ? tile.words[0] : cells, tile.flat ? 1 + tile.paint : 0},
            {float(picture.x), float(picture.y), float(squares.side()), float(tile.grid.cellSize())},
            {}};
}

/// Each tile by itself: a longer rectangle would have corners of its neighbours on its edges, where rounding
/// leaves gaps.
Geometry geometryOf(const UploadedAsset& asset, const Atlas& atlas, const Squares& squares,
                    const std::vector<const Placed*>& placed) {
    Geometry geometry;
    auto next = placed.begin();
    for (std::int64_t y = squares.min.y; y < squares.max.y; ++y)
        for (std::int64_t x = squares.min.x; x < squares.max.x; ++x) {
            const Placed& tile = **next++;
            if (!squares.visible({x, y}) || (tile.flat && tile.paint == 0))
                continue;
            geometry.drawn = geometry.drawn.joined(squares.pixelsOf(i64vec2(x, y)));
            for (const std::uint16_t cell : tile.crowded)
                geometry.crowded = geometry.crowded.joined(squares.pixelsOfCell({x, y}, tile.grid, cell));
            if (tile.flat && tile.paints == TilePaints::Solid) {
                addSquare(geometry.flat, squares, {x, y},
                          flatVertex(asset.paints[atlas.firstPaint() + tile.paint], tile.words));
                continue;
            }
            TileVertex vertex = tileVertex(squares, tile, x, y);
            const std::optional<asset::Texel> pair = atlas.twoColors(tile);
            vertex.pair = pair.value_or(asset::Texel{});
            addSquare(pair ? geometry.twoColors : geometry.of(tile, squares.minSteepness()), squares, {x, y},
                      vertex);
        }
    return geometry;
}

/// All of the map's pixels from the scanner, as crowded ones.
Geometry scannedGeometry(Atlas& atlas, const Squares& map) {
    Geometry geometry;
    geometry.drawn = geometry.crowded = map.pixelsOf(i64vec2(0));
    if (geometry.crowded.empty())
        return geometry;
    const Placed& tile = atlas.prepareCrowded();
    const TileVertex vertex = tileVertex(map, tile, 0, 0);
    addTriangles(geometry.solid, vertex, [&](i64vec2 c) {
        const PixelBox& box = geometry.crowded;
        return dvec2(box.min) + dvec2(c) * dvec2(box.size());
    });
    return geometry;
}

/// What a box will show when the picture is so much larger about the same middle.
PixelBox boxAhead(const PixelBox& box, double scale) {
    const dvec2 middle = 0.5 * dvec2(box.min + box.max), reach = 0.5 * dvec2(box.size()) / scale;
    return {glm::ivec2(glm::floor(middle - reach)), glm::ivec2(glm::ceil(middle + reach))};
}

Geometry preparedGeometry(const UploadedAsset& asset, Atlas& atlas, const Squares& squares, int level,
                          const asset::View& view, const PixelBox& box) {
    const Geometry geometry =
        geometryOf(asset, atlas, squares, atlas.prepare({level, squares.min, squares.max}));
    if (const std::optional<Atlas::Zoom> zoom = atlas.zoomTo(view)) {
        const int next = level + zoom->levels;
        const Squares ahead(atlas.map(), view, boxAhead(box, zoom->scale), next);
        atlas.prepareAhead({next, ahead.min, ahead.max});
    }
    return geometry;
}

template <class Vertex>
void draw(const VertexArrayHandle& array, const BufferHandle& buffer, const std::vector<Vertex>& vertices) {
    glBindVertexArray(array.get());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.get());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(),
                 GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size()));
}

void setMatrix(GLint uniform, const glm::dmat2& m) {
    glUniform4f(uniform, float(m[0].x), float(m[0].y), float(m[1].x), float(m[1].y));
}

void use(const Program& program, const Sections& s, std::uint32_t firstPaint, const asset::View& view,
         double side) {
    const glm::dmat2 toPixels(view.toPixels[0] * side, view.toPixels[1] * side);
    program.use();
    glUniform2f(program.uniform("targetSize"), float(view.width), float(view.height));
    glUniform4ui(program.uniform("sections"), s.leaves, s.pieces, s.paints + firstPaint, s.data);
    glUniform1ui(program.uniform("imageSection"), s.images);
    glUniform1ui(program.uniform("rampSums"), s.rampSums);
    const bool mirrored = glm::determinant(toPixels) < 0;
    setMatrix(program.uniform("toBox"), mirrored ? glm::dmat2(-1, 0, 0, 1) * toPixels : toPixels);
    setMatrix(program.uniform("toTile"), glm::inverse(toPixels));
    const glm::dmat2 pixel = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    glUniform1f(program.uniform("minSteepness"), asset::minSteepness(pixel));
}

void bindTexture(Unit unit, const TextureHandle& texture) {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, texture.get());
}

}  // namespace

PictureBuffers::PictureBuffers()
    : flatArray(makeVertexArray()), tileArray(makeVertexArray()), flat(makeBuffer()), tile(makeBuffer()) {
    glBindVertexArray(flatArray.get());
    glBindBuffer(GL_ARRAY_BUFFER, flat.get());
    pointFloats(0, 2, sizeof(FlatVertex), offsetof(FlatVertex, position));
    pointFloats(1, 4, sizeof(FlatVertex), offsetof(FlatVertex, color));
    glBindVertexArray(tileArray.get());
    glBindBuffer(GL_ARRAY_BUFFER, tile.get());
    pointFloats(0, 2, sizeof(TileVertex), offsetof(TileVertex, position));
    pointFloats(1, 2, sizeof(TileVertex), offsetof(TileVertex, origin));
    pointWords(2, 3, sizeof(TileVertex), offsetof(TileVertex, texels));
    pointFloats(3, 4, sizeof(TileVertex), offsetof(TileVertex, picture));
    pointWords(4, 4, sizeof(TileVertex), offsetof(TileVertex, pair));
    glBindVertexArray(0);
}

PixelBox drawMap(Programs& programs, PictureBuffers& buffers, const UploadedAsset& asset, Atlas& atlas,
                 const asset::View& view, const PixelBox& box, Finish finish, bool markOverruns) {
    const bool scanned = atlas.isScanned(view);
    const int level = scanned ? 0 : tileLevelFor(atlas.map(), view);
    const Squares squares(atlas.map(), view, box, level);
    const Geometry geometry =
        scanned ? scannedGeometry(atlas, squares) : preparedGeometry(asset, atlas, squares, level, view, box);
    if (!geometry.crowded.empty()) {
        const bool light = finish.has(Finish::LinearLight);
        atlas.scanned().scan(view, geometry.crowded, light ? asset::Sums::Light : asset::Sums::Encoded);
        bindTexture(Unit::Layer, atlas.scanned().texture());
    }
    bindTexture(Unit::Texels, asset.records.texture());
    bindTexture(Unit::Images, asset.images);
    bindTexture(Unit::Tiles, atlas.texture());
    const Sections& sections = asset.sections;
    const auto drawAll = [&](const Program& program, const VertexArrayHandle& array,
                             const BufferHandle& buffer, const auto& vertices) {
        use(program, sections, atlas.firstPaint(), view, squares.side());
        glUniform1i(program.uniform("markOverruns"), markOverruns);
        glUniform2i(program.uniform("scannedCorner"), geometry.crowded.min.x, geometry.crowded.min.y);
        draw(array, buffer, vertices);
    };
    const bool crowded = !geometry.crowded.empty();
    if (!geometry.flat.empty())
        drawAll(programs.flat(finish), buffers.flatArray, buffers.flat, geometry.flat);
    const auto drawTiles = [&](const Program& program, const std::vector<TileVertex>& vertices) {
        drawAll(program, buffers.tileArray, buffers.tile, vertices);
    };
    if (!geometry.twoColors.empty())
        drawTiles(crowded ? programs.tile({}, 0, finish, crowded) : programs.twoColorTile(finish),
                  geometry.twoColors);
    if (!geometry.solid.empty())
        drawTiles(programs.tile({}, 0, finish, crowded), geometry.solid);
    for (std::size_t i = 0; i < geometry.plain.size(); ++i) {
        const auto& [flat, others] = geometry.plain[i];
        const bool isBent = rampPoints[i].count > 1;
        const auto drawPlain = [&](const Program& program, const std::vector<TileVertex>& vertices) {
            program.use();
            glUniform1ui(program.uniform("rampPoints"), rampPoints[i].count);
            drawTiles(program, vertices);
        };
        if (!flat.empty())
            drawPlain(programs.plainFlat(asset.features, isBent, finish), flat);
        if (!others.empty())
            drawPlain(programs.plainTile(asset.features, isBent, finish, crowded), others);
    }
    if (!geometry.programs.empty())
        drawTiles(programs.tile(asset.features, asset.materialSet, finish, crowded), geometry.programs);
    return geometry.drawn;
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

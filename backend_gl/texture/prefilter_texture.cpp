#include "backend_gl/texture/prefilter_texture.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "asset/instances.hpp"
#include "asset/walk.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/core/shader_text.hpp"
#include "backend_gl/core/software_driver.hpp"
#include "backend_gl/core/turns.hpp"
#include "backend_gl/output/target.hpp"

namespace vtm::gl {

namespace {

using asset::AssetView;
using asset::Entry;
using asset::PyramidSize;
using glm::dvec2;
using glm::ivec2;

/// RGBA8, with all levels.
TextureHandle makePyramid(PyramidSize size) {
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
    return texture;
}

// ---- What a texel takes ---------------------------------------------------------------------------

/// Turns of loops that the costliest texel takes, about: what shaders/texture counts for squares and pieces,
/// and the steps to them.
class TexelTurns {
public:
    TexelTurns(const AssetView& asset, PyramidSize size)
        : asset_(asset),
          ofPrograms_(programTurns(asset)),
          size_(size.width, size.height),
          scale_(dvec2(size_) / dvec2(asset.width, asset.height)),
          turns_(size.texels()) {}

    double most() {
        asset::forEachMap(asset_, asset_.maps[asset_.commands[0].map],
                          [&](const asset::PlacedMap& placed) { return add(placed); });
        return *std::ranges::max_element(turns_);
    }

private:
    static constexpr double ofSquare = 8, ofPlacedMap = 16, ofPiece = 10;

    bool add(const asset::PlacedMap& placed) {
        const glm::dmat2& linear = placed.toPicture.linear;
        const dvec2 size = glm::abs(linear[0]) + glm::abs(linear[1]);
        const auto addSquare = [&](dvec2 middle, double side, double turns) {
            add(placed.toPicture(middle) - 0.5 * side * size, side * size, turns);
        };
        addSquare(dvec2(0.5), 1, ofPlacedMap);
        asset::walk(asset_, placed.map.root, [&](asset::Cell cell, Entry entry) {
            const double side = std::ldexp(1.0, -2 * int(cell.level));
            addSquare((dvec2(cell.x, cell.y) + 0.5) * side, side, turnsOf(placed, entry));
        });
        return true;
    }

    double turnsOf(const asset::PlacedMap& placed, Entry entry) const {
        const auto ofPaint = [&](std::uint32_t number) { return ofPrograms_[placed.paints(number)]; };
        if (entry.kind() == Entry::Kind::Solid)
            return ofSquare + ofPaint(entry.payload());
        const asset::Leaf& leaf = asset_.leaves[entry.payload()];
        std::set<std::uint16_t> paints(leaf.corners.begin(), leaf.corners.end());
        for (const asset::Piece& piece : asset_.pieces.subspan(leaf.firstPiece, leaf.pieceCount))
            paints.insert({piece.left, piece.right});
        double turns = ofSquare + ofPiece * leaf.pieceCount;
        for (const std::uint16_t paint : paints)
            turns += ofPaint(paint);
        return turns;
    }

    void add(dvec2 corner, dvec2 size, double turns) {
        const ivec2 from = texelOf(corner), to = texelOf(corner + size);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                turns_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)] += turns;
    }
    ivec2 texelOf(dvec2 point) const { return ivec2(glm::clamp(point * scale_, dvec2(0), dvec2(size_ - 1))); }

    const AssetView& asset_;
    const std::vector<std::uint32_t> ofPrograms_;
    const ivec2 size_;
    const dvec2 scale_;
    std::vector<double> turns_;
};

/// LevelDrawer that are drawn finer than the base: where programs vary within a texel, a quarter of it at
/// most as on the CPU (raster/src/prefilter.cpp), which in addition divides pixels of hard changes.
unsigned finerLevels(const AssetView& asset, PyramidSize size) {
    constexpr unsigned quarters = 2, minSide = 256;
    if (std::ranges::none_of(asset.paints, asset::isProgram))
        return 0;
    unsigned levels = quarters;
    while (std::max(size.width, size.height) << levels < minSide)
        ++levels;
    return levels;
}

/// In memory, 64 MiB of RGBA32F.
constexpr unsigned maxDrawnSide = 2048;

bool canBeDrawn(const AssetView& asset, PyramidSize size) {
    return asset.images.empty() && asset.materials.empty() &&
           std::max(size.width, size.height) << finerLevels(asset, size) <= maxDrawnSide &&
           TexelTurns(asset, size).most() <= turnsPerPixel;
}

// ---- Drawing --------------------------------------------------------------------------------------

ivec2 extentOf(PyramidSize size) { return ivec2(size.width, size.height); }

/// Draws whole levels of textures. The framebuffer is its own, since contexts do not share them.
class LevelDrawer {
public:
    LevelDrawer() {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
        glBindVertexArray(array_.get());
    }

    void draw(const TextureHandle& texture, unsigned level, ivec2 size) const {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.get(),
                               GLint(level));
        glViewport(0, 0, size.x, size.y);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

private:
    FramebufferHandle framebuffer_ = makeFramebuffer();
    VertexArrayHandle array_ = makeVertexArray();
};

/// The finest level, in floats.
TextureHandle drawFinest(const LevelDrawer& levels, const Program& program, const VtmUniform& uniform,
                         GLuint records, ivec2 size, GLenum format) {
    TextureHandle finest = makeTexture(format, size.x, size.y);
    program.use();
    uniform.set(program.name(), "vtm_picture", {});
    glUniform2f(program.uniform("vtm_parts"), float(size.x), float(size.y));
    glUniform1i(program.uniform("vtm_picture.texels"), 0);
    glBindTexture(GL_TEXTURE_2D, records);
    levels.draw(finest, 0, size);
    return finest;
}

PrefilterTexture drawPrefilter(const PrefilterPrograms& programs, const VtmUniform& uniform, GLuint records,
                               PyramidSize size, unsigned finerLevels, GLenum format) {
    const LevelDrawer levels;
    PrefilterTexture pyramid{size, makePyramid(size)};
    const PyramidSize whole{size.width << finerLevels, size.height << finerLevels};
    TextureHandle finer = drawFinest(levels, programs.mean, uniform, records, extentOf(whole), format);
    programs.coarser.use();
    // Each from the one before, which is kept in floats, so that no rounding is carried on.
    for (unsigned l = 0; l < whole.levels(); ++l) {
        const ivec2 of = extentOf(whole.level(l)), texels = extentOf(whole.level(l == 0 ? 0 : l - 1)) / of;
        TextureHandle means = l == 0 ? TextureHandle() : makeTexture(format, of.x, of.y);
        glBindTexture(GL_TEXTURE_2D, finer.get());
        glUniform2i(programs.coarser.uniform("texels"), texels.x, texels.y);
        if (l >= finerLevels)
            levels.draw(pyramid.texture, l - finerLevels, of);
        if (l == 0)
            continue;
        levels.draw(means, 0, of);
        finer = std::move(means);
    }
    checkErrors("drawing a prefilter");
    return pyramid;
}

}  // namespace

PrefilterTexture uploadPrefilter(const asset::PrefilterView& prefilter) {
    const PyramidSize& size = prefilter.size;
    TextureHandle texture = makePyramid(size);
    for (unsigned l = 0; l < size.levels(); ++l) {
        const PyramidSize level = size.level(l);
        glTexSubImage2D(GL_TEXTURE_2D, GLint(l), 0, 0, GLsizei(level.width), GLsizei(level.height), GL_RGBA,
                        GL_UNSIGNED_BYTE, prefilter.texels.data() + size.texelsBefore(l));
    }
    checkErrors("upload of a prefilter");
    return {size, std::move(texture)};
}

ProgramSource meanSource(Features features, SampledKinds kinds) {
    ProgramSource source("mean", {shaders::screen_vertex}, {});
    source.fragment = {"#version 300 es\n", sampleText(features, kinds, {}),
                       std::string(shaders::mean_fragment)};
    return source;
}
ProgramSource coarserSource() { return {"coarser", {shaders::screen_vertex}, {shaders::coarser_fragment}}; }

PrefilterPrograms::PrefilterPrograms(Features features, SampledKinds kinds)
    : mean(meanSource(features, kinds)), coarser(coarserSource()) {}

PrefilterTexture PrefilterMaker::make(const AssetView& asset, const asset::PrefilterOptions& options,
                                      Pixels pixels, const VtmUniform& uniform, GLuint records) {
    if (!asset.prefilter.size.empty())
        return uploadPrefilter(asset.prefilter);
    const PyramidSize size = asset::prefilterSize(asset, options);
    const bool draws = !drawsOnCpu(pixels) && floatFormat() && canBeDrawn(asset, size);
    if (!draws) {
        const asset::Prefilter made = asset::buildPrefilter(asset, size, options.threads);
        return uploadPrefilter({made.size, made.texels});
    }
    if (!programs_)
        programs_.emplace(features_, kinds_);
    return drawPrefilter(*programs_, uniform, records, size, finerLevels(asset, size), *floatFormat());
}

}  // namespace vtm::gl

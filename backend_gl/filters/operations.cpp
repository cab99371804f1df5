#include "backend_gl/filters/operations.hpp"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "raster/filter_tables.hpp"

namespace vtm::gl {

namespace {

using asset::FilterOp;

/// Of what comes before the last pass.
const asset::PixelRect everything{glm::dvec2(-1e9), glm::dvec2(1e9)};

void drawPerPixel(FilterLayers& layers, FilterOp op, const FilterStep& step, const asset::PixelRect& cut,
                  const FilterLayer& first, const FilterLayer* second, const FilterLayer& result) {
    FilterLayers::Pass pass = layers.pass(FilterProgram::PerPixel, result, FilterVariant(op));
    pass.first(first).numbers(step.primitive).cut(cut);
    if (second)
        pass.second(*second);
    glUniform1i(pass.uniform("isLight"), result.linear);
    pass.draw();
}

/// Each input over those before it.
void drawMerged(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    FilterLayer below;
    const std::size_t count = step.inputs.size();
    for (std::size_t i = 0; i + 1 < count; ++i) {
        FilterLayer next = layers.make(result.box, result.linear);
        drawPerPixel(layers, FilterOp::Merge, step, everything, *step.inputs[i], &below, next);
        layers.giveBack(std::exchange(below, std::move(next)));
    }
    const FilterLayer none;
    drawPerPixel(layers, FilterOp::Merge, step, step.own, count == 0 ? none : *step.inputs.back(), &below,
                 result);
    layers.giveBack(std::move(below));
}

void drawOffset(FilterLayers& layers, const FilterLayer& input, glm::dvec2 by, bool inWholePixels,
                const asset::PixelRect& cut, const FilterLayer& result) {
    if (inWholePixels)
        by = glm::round(by);
    constexpr double far = 1e8;  // pixels
    const FilterLayer none;
    const bool isNear = std::abs(by.x) < far && std::abs(by.y) < far;
    FilterLayers::Pass pass = layers.pass(FilterProgram::Move, result, FilterVariant(FilterOp::Offset));
    pass.first(isNear ? input : none).cut(cut);
    glUniform2f(pass.uniform("by"), isNear ? float(by.x) : 0, isNear ? float(by.y) : 0);
    pass.draw();
}

void drawShadow(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const asset::FilterParameters& p = step.parameters;
    const glm::dvec2 scale = step.place.scale, deviation = glm::dvec2(p[2], p[3]) * scale;
    FilterLayer moved = layers.make(
        result.box.grown({asset::blurReach(deviation.x), asset::blurReach(deviation.y)}), result.linear);
    drawOffset(layers, *step.inputs[0], glm::dvec2(p[0], p[1]) * scale, step.place.inWholePixels, everything,
               moved);
    FilterLayer shadow = layers.make(result.box, result.linear);
    drawBlurred(layers, moved, deviation, everything, shadow);
    layers.giveBack(std::move(moved));
    drawPerPixel(layers, FilterOp::DropShadow, step, step.own, *step.inputs[0], &shadow, result);
    layers.giveBack(std::move(shadow));
}

void drawDisplaced(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const asset::FilterParameters& p = step.parameters;
    FilterLayers::Pass pass =
        layers.pass(FilterProgram::Move, result, FilterVariant(FilterOp::DisplacementMap));
    pass.first(*step.inputs[0]).second(*step.inputs[1]).cut(step.own);
    const glm::dvec2 by = double(p[0]) * step.place.scale;
    glUniform2f(pass.uniform("by"), float(by.x), float(by.y));
    const auto setChannel = [&](const char* name, float channel) {
        glUniform4f(pass.uniform(name), channel == 0, channel == 1, channel == 2, channel == 3);
    };
    setChannel("channelX", p[1]);
    setChannel("channelY", p[2]);
    pass.draw();
}

void drawTiles(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const asset::PixelRect& region = step.regions[0];
    const glm::dvec2 size = region.max - region.min, first(result.box.min);
    constexpr double least = 1.0 / 64;  // of a pixel: below, a tile shows nothing
    const bool shows = size.x >= least && size.y >= least;
    const FilterLayer none;
    FilterLayers::Pass pass = layers.pass(FilterProgram::Move, result, FilterVariant(FilterOp::Tile));
    pass.first(shows ? *step.inputs[0] : none).cut(step.own);
    const glm::dvec2 corner = region.min - first, sides = shows ? size : glm::dvec2(1);
    const glm::dvec2 phase = -corner - sides * glm::floor(-corner / sides);
    glUniform4f(pass.uniform("tile"), float(corner.x), float(corner.y), float(sides.x), float(sides.y));
    glUniform2f(pass.uniform("tilePhase"), float(phase.x), float(phase.y));
    pass.draw();
}

void drawConvolved(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    layers.pass(FilterProgram::Convolve, result)
        .first(*step.inputs[0])
        .numbers(step.primitive)
        .cut(step.own)
        .box("region", step.regions[0].pixels())
        .draw();
}

void drawLit(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const glm::dvec2 scale = step.place.scale, origin = step.place.origin - glm::dvec2(result.box.min);
    const auto point = [&](std::size_t first) {
        const asset::FilterParameters& p = step.parameters;
        const double mean = std::sqrt((scale.x * scale.x + scale.y * scale.y) / 2);
        return glm::dvec3(p[first] * scale.x + origin.x, p[first + 1] * scale.y + origin.y,
                          p[first + 2] * mean);
    };
    constexpr std::size_t firstOfPosition = 8, firstOfTarget = 11;
    const glm::dvec3 position = point(firstOfPosition), towards = point(firstOfTarget) - position;
    const glm::dvec3 axis = glm::length(towards) > 0 ? glm::normalize(towards) : glm::dvec3(0);
    FilterLayers::Pass pass = layers.pass(FilterProgram::Light, result);
    pass.first(*step.inputs[0]).numbers(step.primitive).cut(step.own).box("region", step.regions[0].pixels());
    glUniform3f(pass.uniform("position"), float(position.x), float(position.y), float(position.z));
    glUniform3f(pass.uniform("axis"), float(axis.x), float(axis.y), float(axis.z));
    glUniform1i(pass.uniform("isLight"), result.linear);
    pass.draw();
}

}  // namespace

void drawCopy(FilterLayers& layers, const FilterLayer& input, const asset::PixelRect& cut,
              const FilterLayer& result) {
    drawOffset(layers, input, glm::dvec2(0), true, cut, result);
}

void drawStep(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const asset::FilterParameters& p = step.parameters;
    const glm::dvec2 scale = step.place.scale;
    switch (step.primitive.op) {
        case FilterOp::DropShadow:
            return drawShadow(layers, step, result);
        case FilterOp::GaussianBlur:
            return drawBlurred(layers, *step.inputs[0], glm::dvec2(p[0], p[1]) * scale, step.own, result);
        case FilterOp::Offset:
            return drawOffset(layers, *step.inputs[0], glm::dvec2(p[0], p[1]) * scale,
                              step.place.inWholePixels, step.own, result);
        case FilterOp::DisplacementMap:
            return drawDisplaced(layers, step, result);
        case FilterOp::Tile:
            return drawTiles(layers, step, result);
        case FilterOp::Morphology:
            return drawExtremes(layers, step, result);
        case FilterOp::ConvolveMatrix:
            return drawConvolved(layers, step, result);
        case FilterOp::Lighting:
            return drawLit(layers, step, result);
        case FilterOp::Turbulence:
            return drawTurbulence(layers, step, result);
        case FilterOp::Merge:
            return drawMerged(layers, step, result);
        default: {
            const FilterLayer none;
            const std::size_t count = step.inputs.size();
            const bool isOver =
                step.primitive.op == FilterOp::Blend && asset::Blend(p[0]) == asset::Blend::Normal;
            return drawPerPixel(layers, isOver ? FilterOp::Merge : step.primitive.op, step, step.own,
                                count > 0 ? *step.inputs[0] : none, count > 1 ? step.inputs[1] : nullptr,
                                result);
        }
    }
}

}  // namespace vtm::gl

#include <vector>

#include "backend_gl/filters/operations.hpp"
#include "raster/filter_tables.hpp"

namespace vtm::gl {

namespace {

using Texels = std::vector<glm::vec4>;

glm::vec4 vector(const std::array<float, 4>& v) { return {v[0], v[1], v[2], v[3]}; }

/// Three rows, as turbulence_fragment.glsl reads them.
Texels latticeTexels(const asset::Noise& noise) {
    Texels texels;
    for (const auto& v : noise.x)
        texels.push_back(vector(v));
    for (const auto& v : noise.y)
        texels.push_back(vector(v));
    for (const std::uint16_t number : noise.lattice)
        texels.emplace_back(number, 0, 0, 0);
    return texels;
}

/// A row an octave, filled up to `width`.
void addPlaces(const std::vector<asset::Noise::Axis>& places, int count, int width, Texels& texels) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const asset::Noise::Axis& place = places[i];
        texels.emplace_back(place.low, place.high, place.rest, place.curve);
        if (int(i) % count == count - 1)
            texels.resize(texels.size() + std::size_t(width - count));
    }
}

TextureHandle textureOf(const Texels& texels, int width) {
    const int height = int(texels.size()) / width;
    TextureHandle texture = makeTexture(GL_RGBA32F, width, height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, texels.data());
    return texture;
}

}  // namespace

void drawTurbulence(FilterLayers& layers, const FilterStep& step, const FilterLayer& result) {
    const asset::FilterPlace& place = step.place;
    const PixelBox& box = result.box;
    const asset::Noise noise =
        asset::noiseOf(step.parameters, step.regions[0], box, place.scale, place.origin);
    const int width = std::max(box.width(), box.height());
    Texels places;
    addPlaces(noise.columns, box.width(), width, places);
    addPlaces(noise.rows, box.height(), width, places);
    if (places.empty())  // no octaves
        places.resize(std::size_t(width));
    glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Layer));
    const TextureHandle lattice = textureOf(latticeTexels(noise), int(asset::latticeEnd));
    glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Backdrop));
    const TextureHandle axes = textureOf(places, width);
    FilterLayers::Pass pass = layers.pass(FilterProgram::Turbulence, result);
    pass.cut(step.own);
    glUniform1i(pass.uniform("octaves"), noise.octaves);
    glUniform1i(pass.uniform("fractal"), noise.fractal);
    pass.draw();
}

}  // namespace vtm::gl

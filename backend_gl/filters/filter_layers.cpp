#include "backend_gl/filters/filter_layers.hpp"

#include <utility>

namespace vtm::gl {

FilterLayer FilterLayers::make(const PixelBox& box, bool linear) {
    FilterLayer layer{{}, box, linear};
    if (!box.empty())
        layer.target = pool_.take(box.size(), GL_RGBA16UI);
    return layer;
}

void FilterLayers::giveBack(FilterLayer&& layer) {
    if (layer.target.texture.get() != 0)
        pool_.giveBack(std::move(layer.target));
    layer = {};
}

FilterLayers::Pass::Pass(const Program& program, const UploadedAsset& asset, const FilterLayer& result)
    : program_(&program), asset_(&asset), result_(&result) {
    result.target.bind();
    glViewport(0, 0, result.box.width(), result.box.height());
    program.use();
    const float everything = 1e9f;
    glUniform4f(uniform("cut"), -everything, -everything, everything, everything);
    glUniform4i(uniform("firstBox"), 0, 0, 0, 0);
    glUniform4i(uniform("secondBox"), 0, 0, 0, 0);
}

FilterLayers::Pass& FilterLayers::Pass::input(const FilterLayer& layer, Unit unit, const char* box) {
    const glm::ivec2 shift = result_->box.min - layer.box.min;
    glUniform4i(uniform(box), shift.x, shift.y, layer.box.width(), layer.box.height());
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(GL_TEXTURE_2D, layer.target.texture.get());
    return *this;
}

FilterLayers::Pass& FilterLayers::Pass::numbers(const asset::FilterPrimitive& primitive) {
    glActiveTexture(GL_TEXTURE0 + GLenum(Unit::Texels));
    glBindTexture(GL_TEXTURE_2D, asset_->records.texture().get());
    constexpr GLuint wordsPerTexel = sizeof(asset::Texel) / sizeof(std::uint32_t);
    glUniform1ui(uniform("firstNumber"),
                 asset_->sections.filterWords * wordsPerTexel + primitive.firstWord + primitive.inputs);
    return *this;
}

FilterLayers::Pass& FilterLayers::Pass::cut(const asset::PixelRect& to) {
    const glm::dvec2 min = to.min - glm::dvec2(result_->box.min), max = to.max - glm::dvec2(result_->box.min);
    glUniform4f(uniform("cut"), float(min.x), float(min.y), float(max.x), float(max.y));
    return *this;
}

FilterLayers::Pass& FilterLayers::Pass::box(const char* name, const PixelBox& box) {
    const PixelBox own = box.moved(-result_->box.min);
    glUniform4i(uniform(name), own.min.x, own.min.y, own.max.x, own.max.y);
    return *this;
}

void FilterLayers::Pass::draw() { glDrawArrays(GL_TRIANGLES, 0, 3); }

}  // namespace vtm::gl

#include "backend_gl/src/programs.hpp"

#include <utility>

#include "backend_gl/src/shader_text.hpp"

namespace vtm::gl {

namespace {

void bindUnits(const Program& program) {
    program.use();
    glUniform1i(program.uniform("texels"), int(Unit::Texels));
    glUniform1i(program.uniform("images"), int(Unit::Images));
    glUniform1i(program.uniform("placements"), int(Unit::Placements));
    glUniform1i(program.uniform("layer"), int(Unit::Layer));
    glUniform1i(program.uniform("backdrop"), int(Unit::Backdrop));
    checkErrors("program");
}

}  // namespace

const Program& Programs::leaf(CostClass cost, Features features) {
    switch (cost) {
        case CostClass::Solid:
            return get(Kind::Solid, {});
        case CostClass::Pieces:
            return get(Kind::Pieces, {});
        default:
            return get(Kind::General, features);
    }
}

const Program& Programs::fill(Features features) { return get(Kind::Fill, features); }
const Program& Programs::layer() { return get(Kind::Layer, {}); }
const Program& Programs::blend() { return get(Kind::Blend, {}); }

const Program& Programs::get(Kind kind, Features features) {
    const std::pair key(kind, features.flags());
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        found = programs_.emplace(key, make(kind, features)).first;
        bindUnits(found->second);
    }
    return found->second;
}

Program Programs::make(Kind kind, Features features) {
    using namespace shaders;
    const std::string defines = features.defines();
    switch (kind) {
        case Kind::Solid:
            return {"solid", {fetch, leaf_vertex}, {fetch, coverage, leaf_placement, solid_fragment}};
        case Kind::Pieces:
            return {"pieces", {fetch, leaf_vertex}, {fetch, coverage, leaf_placement, pieces_fragment}};
        case Kind::General:
            return {"general",
                    {fetch, leaf_vertex},
                    {defines, fetch, coverage, leaf_placement, shaders::blend, gradient, image, paint,
                     general_fragment}};
        case Kind::Fill:
            return {"fill",
                    {box_vertex},
                    {defines, fetch, shaders::blend, gradient, image, paint, fill_fragment}};
        case Kind::Layer:
            return {"layer", {box_vertex}, {shaders::blend, layer_fragment}};
        default:
            return {"blend", {box_vertex}, {shaders::blend, blend_fragment}};
    }
}

}  // namespace vtm::gl

#include "backend_gl/src/programs.hpp"

#include "shader_text.hpp"

namespace vtm::gl {

namespace {

void bindUnits(const Program& program) {
    program.use();
    glUniform1i(program.uniform("texels"), int(Unit::Texels));
    glUniform1i(program.uniform("images"), int(Unit::Images));
    glUniform1i(program.uniform("placements"), int(Unit::Placements));
    glUniform1i(program.uniform("layer"), int(Unit::Layer));
    glUniform1i(program.uniform("backdrop"), int(Unit::Backdrop));
}

}  // namespace

Programs::Programs()
    : solid("solid", {shaders::fetch, shaders::leaf_vertex},
            {shaders::fetch, shaders::coverage, shaders::leaf_placement, shaders::solid_fragment}),
      pieces("pieces", {shaders::fetch, shaders::leaf_vertex},
             {shaders::fetch, shaders::coverage, shaders::leaf_placement, shaders::pieces_fragment}),
      general("general", {shaders::fetch, shaders::leaf_vertex},
              {shaders::fetch, shaders::coverage, shaders::leaf_placement, shaders::blend, shaders::gradient,
               shaders::image, shaders::paint, shaders::general_fragment}),
      composite("composite", {shaders::box_vertex},
                {shaders::fetch, shaders::blend, shaders::gradient, shaders::image, shaders::paint,
                 shaders::composite_fragment}) {
    for (const Program* program : all())
        bindUnits(*program);
    checkErrors("programs");
}

const Program& Programs::of(CostClass cost) const {
    switch (cost) {
        case CostClass::Solid:
            return solid;
        case CostClass::Pieces:
            return pieces;
        default:
            return general;
    }
}

}  // namespace vtm::gl

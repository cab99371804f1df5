#include "api/openvg/gl/programs.hpp"

#include <array>

#include <VG/vgext.h>
#include <fmt/format.h>

#include "api/openvg/gl/shader_text.hpp"

namespace vtm::openvg::gl {

namespace {

/// The mode's function in blend_modes.glsl.
const char* blendName(int mode) {
    constexpr std::array advanced{"overlay",     "hardLight",  "softLightSvg", "softLight",   "colorDodge",
                                  "colorBurn",   "difference", "subtract",     "invert",      "exclusion",
                                  "linearDodge", "linearBurn", "vividLight",   "linearLight", "pinLight",
                                  "hardMix",     "clear",      "dst",          "srcOut",      "dstOut",
                                  "srcAtop",     "dstAtop",    "exclusiveOr"};
    static_assert(advanced.size() == VG_BLEND_XOR_KHR - VG_BLEND_OVERLAY_KHR + 1);
    switch (mode) {
        case VG_BLEND_SRC:
            return "src";
        case VG_BLEND_DST_OVER:
            return "dstOver";
        case VG_BLEND_SRC_IN:
            return "srcIn";
        case VG_BLEND_DST_IN:
            return "dstIn";
        case VG_BLEND_MULTIPLY:
            return "multiply";
        case VG_BLEND_SCREEN:
            return "screen";
        case VG_BLEND_DARKEN:
            return "darken";
        case VG_BLEND_LIGHTEN:
            return "lighten";
        case VG_BLEND_ADDITIVE:
            return "additive";
        default:
            return mode >= VG_BLEND_OVERLAY_KHR && mode <= VG_BLEND_XOR_KHR
                       ? advanced[std::size_t(mode - VG_BLEND_OVERLAY_KHR)]
                       : "srcOver";
    }
}

std::string macrosOf(const ProgramKey& key, bool fetches) {
    constexpr std::array sources{"SOLID", "LINEAR", "RADIAL", "TEXELS"},
        filters{"MATRIX", "TABLES", "TABLE", "SUMS"};
    std::string text = fmt::format("#define SOURCE_{}\n#define FILTER_{}\n#define BLEND {}\n",
                                   sources[std::size_t(key.source)], filters[std::size_t(key.filter)],
                                   blendName(key.blendMode));
    const std::pair<bool, const char*> flags[]{{key.transforms, "TRANSFORMS"},
                                               {key.multiplies, "MULTIPLIES"},
                                               {key.isStencil, "STENCIL"},
                                               {key.isMasked, "MASKED"},
                                               {key.readsSums, "READS_SUMS"},
                                               {key.writesSums, "WRITES_SUMS"},
                                               {fetches, "FETCHES"}};
    for (const auto& [isSet, name] : flags)
        if (isSet)
            text += fmt::format("#define {}\n", name);
    return text;
}

}  // namespace

ProgramText programText(const ProgramKey& key, bool fetches) {
    // What does not depend on the target is not fetched.
    std::string head = "#version 300 es\n" + macrosOf(key, fetches && key.mayReadTarget());
    head += shaders::layer_prelude;
    ProgramText text{head, head};
    text.vertex += shaders::cover_vertex;
    const auto add = [&](std::initializer_list<std::string_view> parts) {
        for (const std::string_view part : parts)
            text.fragment += part;
    };
    add({shaders::spaces, shaders::surface_pixel});
    if (key.task == ProgramKey::Task::store)
        add({shaders::store_fragment});
    else if (key.task == ProgramKey::Task::copy)
        add({shaders::copy_fragment});
    else if (key.task == ProgramKey::Task::filter)
        add({shaders::tiling, shaders::filter_fragment});
    else {
        add({shaders::blend_modes, shaders::tiling, shaders::texel_field});
        if (key.source == SourceKind::linear || key.source == SourceKind::radial)
            add({shaders::gradient_field});
        add({shaders::layer_fragment});
    }
    return text;
}

GLuint Programs::compile(GLenum stage, const std::string& text) {
    const GLuint shader = gl_.CreateShader(stage);
    const char* const source = text.c_str();
    gl_.ShaderSource(shader, 1, &source, nullptr);
    gl_.CompileShader(shader);
    GLint isCompiled = GL_FALSE;
    gl_.GetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
    if (isCompiled)
        return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl_.GetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(length));
    gl_.DeleteShader(shader);
    throw ProgramError("a shader does not compile: " + log);
}

GLuint Programs::link(const ProgramKey& key) {
    const ProgramText text = programText(key, fetches_);
    const GLuint program = gl_.CreateProgram();
    for (const auto& [stage, source] :
         {std::pair(GL_VERTEX_SHADER, &text.vertex), std::pair(GL_FRAGMENT_SHADER, &text.fragment)}) {
        const GLuint shader = compile(GLenum(stage), *source);
        gl_.AttachShader(program, shader);
        gl_.DeleteShader(shader);  // once the program is
    }
    gl_.LinkProgram(program);
    GLint isLinked = GL_FALSE;
    gl_.GetProgramiv(program, GL_LINK_STATUS, &isLinked);
    if (!isLinked) {
        gl_.DeleteProgram(program);
        throw ProgramError("a program does not link");
    }
    gl_.UseProgram(program);
    constexpr std::array names{"shares", "sourceTexels", "otherTexels", "mask", "ramps", "backdrop"};
    for (std::size_t unit = 0; unit < names.size(); ++unit)
        gl_.Uniform1i(gl_.GetUniformLocation(program, names[unit]), GLint(unit));
    gl_.UniformBlockBinding(program, gl_.GetUniformBlockIndex(program, "LayerBlock"), 0);
    return program;
}

void Programs::use(const ProgramKey& key) {
    auto it = programs_.find(key);
    if (it == programs_.end())
        it = programs_.emplace(key, link(key)).first;
    gl_.UseProgram(it->second);
}

}  // namespace vtm::openvg::gl

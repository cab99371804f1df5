#include "paper/gl/programs.hpp"

#include <string_view>

#include <fmt/format.h>

#include "backend_gl/core/programs.hpp"
#include "backend_gl/core/shader_text.hpp"
#include "paper/evaluate.hpp"
#include "paper/gl/shader_text.hpp"
#include "paper/gl/texels.hpp"

namespace vtm::paper {

namespace {

/// The numbers that C++ and the shaders share.
std::string constants() {
    return fmt::format(
               "const uint paperNone = {}u;\nconst uint paperBounds = {}u;\nconst uint paperIntersection = "
               "{}u;\nconst int paperPending = "
               "{};\n",
               noIndex, hasBounds, 1 + unsigned(Operator::Intersection), maxPending) +
           fmt::format(
               "const float paperMargin = {:.17g};\nconst float paperExtent = {:.1f};\n"
               "const float paperSlopeScale = {:.17g};\nconst float paperMaxLod = {:.1f};\n",
               cellMargin, cellExtent, slopeScale, maxLod);
}

std::string patternConstants() {
    return fmt::format("const uint patternInside = {}u;\nconst float patternLargest = {:.17g};\n",
                       unsigned(PatternKind::Inside), 1 - 0x1p-24);
}

std::string surfaceDefine(Shown shown) {
    return fmt::format("#define SURFACE {:d}\n", shown == Shown::Surface);
}

std::string_view vertexOf(Shown shown) {
    return shown == Shown::Surface ? shaders::paper_surface_vertex : gl::shaders::screen_vertex;
}

}  // namespace

gl::ProgramSource mapSource(gl::Features features, const std::string& materials, MapParts parts) {
    using namespace gl::shaders;
    using namespace shaders;
    const std::string defines = features.defines() + surfaceDefine(parts.shown) +
                                fmt::format("#define MIPS {:d}\n", parts.mips),
                      numbers = constants();
    return {"paper",
            {vertexOf(parts.shown)},
            {defines, numbers, fetch, blend, gradient, gl::shaders::image, paint, paper_hermite, paper_mask,
             paper_fragment, materials}};
}

gl::ProgramSource patternSource(const PatternParts& parts) {
    using namespace gl::shaders;
    using namespace shaders;
    const std::string defines = fmt::format(
        "#define COMPRESSED {:d}\n#define FILTERED {:d}\n#define LINEAR {:d}\n#define CELLS {:d}\n#define "
        "MIP {:d}\n"
        "#define DEPTH {}\n{}",
        parts.compressed, parts.filtered, parts.linear, parts.cells, parts.mip, parts.depth,
        surfaceDefine(parts.shown));
    const std::string numbers = patternConstants();
    return {"pattern", {vertexOf(parts.shown)}, {defines, numbers, paper_hermite, paper_pattern_fragment}};
}

std::vector<gl::ProgramSource> everySource() {
    using gl::Features;
    std::vector<gl::ProgramSource> sources;
    const std::string materials = gl::materialsSource({});
    const auto add = [&](unsigned features, MapParts parts = {}) {
        const bool hasMaterials = Features(features).has(Features::Material);
        sources.push_back(mapSource(Features(features), hasMaterials ? materials : "", parts));
    };
    for (unsigned features = 0; features < Features::LongRamps; ++features)
        add(features);
    add(Features::Linear | Features::LongRamps);
    add(Features::combinations - 1);
    for (const unsigned features : {0u, Features::combinations - 1}) {
        add(features, {Shown::Surface, true});
        add(features, {Shown::View, false});
    }
    for (unsigned form = 0; form < 16; ++form)
        sources.push_back(
            patternSource({(form & 1) != 0, (form & 2) != 0, (form & 4) != 0, true, (form & 8) != 0, 3}));
    sources.push_back(patternSource({.cells = false}));
    for (const bool filtered : {false, true})
        sources.push_back(
            patternSource({.filtered = filtered, .mip = filtered, .depth = 3, .shown = Shown::Surface}));
    return sources;
}

}  // namespace vtm::paper

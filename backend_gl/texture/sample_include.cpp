#include "backend_gl/texture/sample_include.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include <vtm/gl/sampled_texture.hpp>
#include <vtm/raster/prefilter.hpp>
#include "asset/instances.hpp"
#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/gl.hpp"
#include "backend_gl/core/programs.hpp"
#include "backend_gl/core/shader_text.hpp"
#include "backend_gl/core/turns.hpp"

namespace vtm::gl {

namespace {

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool isBlank(char c) { return c == ' ' || c == '\t'; }

std::string withoutComments(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i, 2) == "//")
            i = std::min(text.find('\n', i), text.size());
        if (i < text.size())
            result += text[i];
    }
    return result;
}

/// Words, single other characters, and runs of blanks.
std::vector<std::string_view> tokens(std::string_view text) {
    std::vector<std::string_view> result;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        for (const auto is : {isWord, isBlank})
            while (is(text[i]) && end < text.size() && is(text[end]))
                ++end;
        result.push_back(text.substr(i, end - i));
        i = end;
    }
    return result;
}

/// What is declared outside all braces: words before `(`, behind `struct`, before `=`; and behind `#define`.
std::set<std::string_view> declared(const std::vector<std::string_view>& all) {
    std::set<std::string_view> names;
    std::string_view last, beforeLast;  // words, blanks left out
    int depth = 0;
    for (const std::string_view token : all) {
        if (isBlank(token[0]))
            continue;
        if (beforeLast == "define" || (depth == 0 && beforeLast == "struct") ||
            (depth == 0 && (token == "(" || token == "=") && isWord(last[0]) && isWord(beforeLast[0])))
            names.insert(last);
        depth += token == "{" || token == "(" ? 1 : token == "}" || token == ")" ? -1 : 0;
        beforeLast = last.empty() ? token : last;
        last = token;
    }
    return names;
}

std::string prefixOf(std::string_view name) {
    for (const std::string_view taken : {"vtm_", "Vtm", "VTM_"})
        if (name.starts_with(taken))
            return "";
    const bool isMacro = std::ranges::none_of(name, [](unsigned char c) { return std::islower(c); });
    return isMacro ? "VTM_" : "vtm_";
}

std::string withoutIdleLines(const std::string& text, const std::vector<std::string_view>& all) {
    std::map<std::string_view, int> uses;
    for (const std::string_view token : all)
        ++uses[token];
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);) {
        line.erase(line.find_last_not_of(" \t") + 1);
        const std::vector<std::string_view> words = tokens(line);
        const bool isIdle = words.size() > 4 && words[0] == "const" && uses[words[4]] == 1;
        if (!line.empty() && !isIdle)
            result += line + '\n';
    }
    return result;
}

}  // namespace

std::string prefixed(std::string_view glsl) {
    const std::string plain = withoutComments(glsl);
    const std::string text = withoutIdleLines(plain, tokens(plain));
    const std::vector<std::string_view> all = tokens(text);
    const std::set<std::string_view> names = declared(all);
    std::string result;
    std::string_view before;
    for (const std::string_view token : all) {
        if (before != "." && names.contains(token))  // behind a point stands a member
            result += prefixOf(token);
        result += token;
        before = token;
    }
    return result;
}

namespace {

using asset::Material;

constexpr const char* head =
    R"(// Vector Texture Maps: uniform Vtm NAME; premultiplied colours, t running down.
//     vec4 vtm_sample(Vtm vtm, vec2 st)
//     vec4 vtm_sample_proj(Vtm vtm, vec3 stq)
//     vec4 vtm_sample_grad(Vtm vtm, vec2 st, vec2 dx, vec2 dy)
// A fragment that takes many samples defines VTM_SAMPLES as their number before this.
#ifndef VTM_SAMPLES
#define VTM_SAMPLES 1
#endif
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
)";

/// Of the loop over taps in sample_prefilter.glsl, and some: at most 4 rows of 16, for a footprint of 4 : 1.
constexpr float prefilterTurns = 4 * (16 + 2) + 1;
/// Footprints are widened to this share of their length.
constexpr float maxAnisotropy = 16;
/// In pictures: smaller ones lose their digits, of larger ones the mean is all that is left.
constexpr float smallestFootprint = 0x1p-26f, largestFootprint = 1024;
/// Largest magnitude of s and t: beyond, single precision has no fractions.
constexpr float largestPlace = 0x1p23f;

std::string constants() {
    std::string text;
    const auto add = [&](const char* name, float value) {
        text += fmt::format("const float {} = {:.9e};\n", name, value);
    };
    const auto addWrap = [&](const char* name, asset::Wrap wrap) {
        text += fmt::format("const int {} = {};\n", name, int(wrap));
    };
    add("turnsPerPixel", float(turnsPerPixel));
    add("prefilterTurns", prefilterTurns);
    add("maxAnisotropy", maxAnisotropy);
    add("smallestFootprint", smallestFootprint);
    add("largestFootprint", largestFootprint);
    add("largestPlace", largestPlace);
    add("fadeFrom", asset::fadeFrom);
    add("fadeTo", asset::fadeTo);
    addWrap("wrapBorder", asset::Wrap::Border);
    addWrap("wrapClamp", asset::Wrap::Clamp);
    addWrap("wrapRepeat", asset::Wrap::Repeat);
    addWrap("wrapMirror", asset::Wrap::Mirror);
    return text;
}

/// As materialsSource, but chosen by key; magenta where the program does without.
std::string keyedMaterials(std::span<const Material> materials) {
    std::string text, choice;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        text += fmt::format("#line 1 {}\n{}\n", materialString + int(i), materials[i].glsl);
        choice +=
            fmt::format("        case {}u: return {}(p);\n", materialKey(materials[i]), materials[i].name);
    }
    return text + "#line 1 0\nvec4 vtm_materialColor(uint material, vec2 p) {\n    switch (material) {\n" +
           choice + "        default: return vec4(1.0, 0.0, 1.0, 1.0);\n    }\n}\n";
}

}  // namespace

unsigned innerMapsOf(const asset::AssetView& asset) {
    const std::vector<unsigned> depths = asset::mapDepths(asset);
    return depths.empty() ? 0 : *std::ranges::max_element(depths) - 1;
}

std::uint32_t materialKey(const Material& material) {
    std::uint32_t hash = 2166136261u;  // FNV-1a
    for (const unsigned char c : material.name + '\n' + material.glsl)
        hash = (hash ^ c) * 16777619u;
    return hash;
}

std::uint32_t samplingFlags(Features features, SampledKinds kinds) {
    const std::uint32_t maps = (1u << kinds.innerMaps) - 1,
                        pages = kinds.pages ? 1u << asset::maxMapDepth : 0;
    return features.flags() | (maps | pages) * Features::combinations;
}

namespace {

/// Of the current context's driver, if there is one: fetch.glsl.
bool samplesTexels() {
    if (!currentContext())
        return false;
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return renderer != nullptr && std::string_view(renderer).find("llvmpipe") != std::string_view::npos;
}

}  // namespace

std::string sampleText(Features features, SampledKinds kinds, std::span<const Material> materials) {
    using namespace shaders;
    std::string text =
        features.defines() + fmt::format(
                                 "#define INNER_MAPS {}\n#define TEXT_PAGES {}\n#define FEATURES {}u\n"
                                 "#define SAMPLED_TEXELS {}\n",
                                 kinds.innerMaps, int(kinds.pages), samplingFlags(features, kinds),
                                 int(samplesTexels()));
    text += glslConstants() + constants();
    const std::string_view images = features.has(Features::Image) ? image : std::string_view();
    for (const std::string_view part :
         {sample_asset, fetch, coverage, blend, gradient, images, paint, placed_paints, leaf_integral,
          sample_prefilter, sample_tree, sample_maps, sample_page, sample})
        text += part;
    text = head + prefixed(text);
    if (features.has(Features::Material))
        text += keyedMaterials(materials);
    return text + "#line 1 0\n";
}

std::string includeFor(std::span<const asset::AssetView> assets, bool pages) {
    unsigned flags = 0;
    SampledKinds kinds{0, pages};
    std::vector<Material> materials;
    for (const asset::AssetView& asset : assets) {
        flags |= featuresOf(asset).flags();
        kinds.innerMaps = std::max(kinds.innerMaps, innerMapsOf(asset));
        for (const Material& material : asset.materials) {
            const auto known = std::ranges::find(materials, material.name, &Material::name);
            if (known == materials.end())
                materials.push_back(material);
            else if (known->glsl != material.glsl)
                throw GlError(fmt::format("two different materials are named '{}'", material.name));
        }
    }
    return sampleText(Features(flags), kinds, materials);
}

std::string sampleInclude(std::initializer_list<asset::AssetView> assets) {
    return includeFor(std::span(assets.begin(), assets.size()), false);
}

std::string sampleInclude(std::span<const asset::AssetView> assets) { return includeFor(assets, false); }

}  // namespace vtm::gl

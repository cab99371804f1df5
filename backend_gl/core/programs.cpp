#include "backend_gl/core/programs.hpp"

#include <regex>
#include <utility>

#include <fmt/format.h>

#include "backend_gl/core/constants.hpp"
#include "backend_gl/core/shader_text.hpp"

namespace vtm::gl {

std::string materialsSource(std::span<const asset::Material> materials) {
    std::string text, choice;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        text += fmt::format("\n#line 1 {}\n{}\n", materialString + int(i), materials[i].glsl);
        choice += fmt::format("        case {}u: return {}(p);\n", i, materials[i].name);
    }
    return text + "#line 1 0\nvec4 materialColor(uint material, vec2 p) {\n    switch (material) {\n" +
           choice + "        default: return vec4(0.0);\n    }\n}\n";
}

std::string blamedOnMaterial(std::span<const asset::Material> materials, const std::string& message) {
    // Mesa and ANGLE write string:line, NVIDIA string(line).
    static const std::regex place(R"((^|[^0-9:(])(\d{5})[:(](\d+))");
    for (std::sregex_iterator at(message.begin(), message.end(), place), end; at != end; ++at) {
        const int index = std::stoi((*at)[2]) - materialString;
        if (index >= 0 && std::size_t(index) < materials.size())
            return fmt::format("material '{}', line {}: {}", materials[std::size_t(index)].name,
                               (*at)[3].str(), message);
    }
    std::string names;
    for (const asset::Material& material : materials)
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", material.name);
    return names.empty() ? message : fmt::format("materials {}: {}", names, message);
}

namespace {

void bindUnits(const Program& program) {
    program.use();
    glUniform1i(program.uniform("texels"), int(Unit::Texels));
    glUniform1i(program.uniform("images"), int(Unit::Images));
    glUniform1i(program.uniform("placements"), int(Unit::Placements));
    glUniform1i(program.uniform("tiles"), int(Unit::Tiles));
    glUniform1i(program.uniform("layer"), int(Unit::Layer));
    glUniform1i(program.uniform("backdrop"), int(Unit::Backdrop));
    // Of filters: their inputs, or the tables of noise.
    glUniform1i(program.uniform("first"), int(Unit::Layer));
    glUniform1i(program.uniform("second"), int(Unit::Backdrop));
    glUniform1i(program.uniform("lattice"), int(Unit::Layer));
    glUniform1i(program.uniform("places"), int(Unit::Backdrop));
    checkErrors("program");
}

}  // namespace

unsigned Programs::materialSet(std::span<const asset::Material> materials) {
    std::string source = materialsSource(materials);
    for (unsigned i = 0; i < materialSets_.size(); ++i)
        if (materialSets_[i].source == source)
            return i;
    materialSets_.push_back({{materials.begin(), materials.end()}, std::move(source)});
    return unsigned(materialSets_.size() - 1);
}

const Program& Programs::leaf(LeafProgram program) {
    return get(program == LeafProgram::Solid ? Kind::Solid : Kind::Pieces, {});
}

const Program& Programs::flat(Finish finish) { return get(Kind::Flat, {}, 0, finish); }
const Program& Programs::plainFlat(Features features, bool isBent, Finish finish) {
    return get(Kind::PlainFlat, plainOf(features, isBent), 0, finish);
}
const Program& Programs::tile(Features features, unsigned materialSet, Finish finish, bool crowded) {
    return get(crowded ? Kind::CrowdedTile : Kind::Tile, features, materialSet, finish);
}
const Program& Programs::solidTile(bool twoColors, bool isLong, Finish finish) {
    if (twoColors)
        return get(isLong ? Kind::LongTwoColorTile : Kind::TwoColorTile, {}, 0, finish);
    return get(isLong ? Kind::LongTile : Kind::Tile, {}, 0, finish);
}
const Program& Programs::plainTile(Features features, bool isBent, Finish finish, bool crowded) {
    return get(crowded ? Kind::CrowdedPlainTile : Kind::PlainTile, plainOf(features, isBent), 0, finish);
}
const Program& Programs::fill(Features features, unsigned materialSet) {
    return get(Kind::Fill, features, materialSet);
}
const Program& Programs::layer() { return get(Kind::Layer, {}); }
const Program& Programs::blend() { return get(Kind::Blend, {}); }

const Program& Programs::compose(Finish finish) { return get(Kind::Compose, {}, 0, finish); }

const Program& Programs::filter(FilterProgram program, FilterVariant variant) {
    const std::pair key(program, variant);
    auto found = filters_.find(key);
    if (found == filters_.end()) {
        found = filters_.emplace(key, Program(filterSource(program, variant), cache_)).first;
        bindUnits(found->second);
    }
    return found->second;
}

/// What plain paints differ by.
Features Programs::plainOf(Features features, bool isBent) {
    return Features((features.has(Features::Radial) ? unsigned(Features::Radial) : 0) |
                    (isBent ? unsigned(Features::RampPoints) : 0));
}

Programs::Key Programs::keyOf(Kind kind, Features features, unsigned materialSet, Finish finish) {
    return {kind, features.flags(), features.has(Features::Material) ? materialSet : 0, finish.flags()};
}

Program& Programs::begun(const Key& key) {
    const auto& [kind, flags, materialSet, finish] = key;
    auto found = programs_.find(key);
    if (found == programs_.end()) {
        const Features features(flags);
        const std::string_view materials =
            features.has(Features::Material) ? std::string_view(materialSets_[materialSet].source) : "";
        found =
            programs_.emplace(key, Program::begin(source(kind, features, Finish(finish), materials), cache_))
                .first;
        if (found->second.isComplete())
            bindUnits(found->second);
    }
    return found->second;
}

const Program& Programs::complete(const Key& key) {
    Program& program = begun(key);
    if (program.isComplete())
        return program;
    try {
        program.complete(cache_);
    } catch (const GlError& error) {
        programs_.erase(key);
        throw GlError(blamedOnMaterial(materialSets_[std::get<2>(key)].materials, error.what()));
    }
    bindUnits(program);
    return program;
}

const Program& Programs::get(Kind kind, Features features, unsigned materialSet, Finish finish) {
    return complete(keyOf(kind, features, materialSet, finish));
}

bool Programs::warmUp(const std::vector<Key>& keys) {
    for (const Key& key : keys)
        begun(key);
    bool ready = true;
    for (const Key& key : keys)
        if (begun(key).isReady())
            complete(key);
        else
            ready = false;
    return ready;
}

bool Programs::warmUpPicture(Features features, unsigned materialSet, Finish finish) {
    std::vector<Key> keys{keyOf(Kind::Flat, {}, 0, finish),
                          keyOf(Kind::Tile, {}, 0, finish),
                          keyOf(Kind::LongTile, {}, 0, finish),
                          keyOf(Kind::TwoColorTile, {}, 0, finish),
                          keyOf(Kind::LongTwoColorTile, {}, 0, finish),
                          keyOf(Kind::Tile, features, materialSet, finish)};
    if (features.has(Features::Linear) || features.has(Features::Radial))
        for (const Kind kind : {Kind::PlainFlat, Kind::PlainTile})
            for (const bool isBent : {false, true})
                keys.push_back(keyOf(kind, plainOf(features, isBent), 0, finish));
    return warmUp(keys);
}

bool Programs::warmUpLayers(Features features, unsigned materialSet) {
    return warmUp({keyOf(Kind::Solid, {}, 0, {}), keyOf(Kind::Pieces, {}, 0, {}),
                   keyOf(Kind::Fill, {}, 0, {}), keyOf(Kind::Fill, features, materialSet, {}),
                   keyOf(Kind::Layer, {}, 0, {}), keyOf(Kind::Blend, {}, 0, {})});
}

bool Programs::warmUpCompose(Finish finish) { return warmUp({keyOf(Kind::Compose, {}, 0, finish)}); }

ProgramSource Programs::source(Kind kind, Features features, Finish finish, std::string_view materials) {
    using namespace shaders;
    const std::string defines = features.defines(), finishes = finish.defines();
    const std::string_view crowded = kind == Kind::CrowdedTile || kind == Kind::CrowdedPlainTile
                                         ? "#define CROWDED 1\n"
                                         : "#define CROWDED 0\n";
    const bool isLong = kind == Kind::LongTile || kind == Kind::LongTwoColorTile,
               hasTwoColors = kind == Kind::TwoColorTile || kind == Kind::LongTwoColorTile;
    const std::string lists =
        fmt::format("#define TWO_COLORS {:d}\n#define LONG_LISTS {:d}\n", int(hasTwoColors), int(isLong));
    const std::string_view finishBlend = finish.flags() == 0 ? std::string_view("") : shaders::blend;
    switch (kind) {
        case Kind::Solid:
            return {"solid", {fetch, leaf_vertex}, {fetch, coverage, leaf_placement, solid_fragment}};
        case Kind::Pieces:
            return {"pieces", {fetch, leaf_vertex}, {fetch, coverage, leaf_placement, pieces_fragment}};
        case Kind::Flat:
            return {"flat", {flat_vertex}, {finishes, finishBlend, output, flat_fragment}};
        case Kind::Tile:
        case Kind::CrowdedTile:
        case Kind::LongTile:
        case Kind::TwoColorTile:
        case Kind::LongTwoColorTile:
            if (features.flags() == 0)
                return {"tile",
                        {block_vertex},
                        {crowded, lists, finishes, fetch, place, shadow, cell, finishBlend, output,
                         tile_fragment}};
            return {"tile with programs",
                    {block_vertex},
                    {crowded, defines, finishes, fetch, place, shadow, cell, shares, shaders::blend, gradient,
                     image, paint, output, tile_programs_fragment, materials}};
        case Kind::PlainFlat:
            return {
                "plain flat",
                {block_vertex},
                {defines, finishes, fetch, place, shaders::blend, plain_paint, output, plain_flat_fragment}};
        case Kind::PlainTile:
        case Kind::CrowdedPlainTile:
            return {"plain tile",
                    {block_vertex},
                    {crowded, defines, finishes, fetch, place, shadow, cell, shares, shaders::blend,
                     plain_paint, output, tile_plain_fragment}};
        case Kind::Fill:
            return {"fill",
                    {box_vertex},
                    {defines, fetch, shaders::blend, gradient, image, paint, fill_fragment, materials}};
        case Kind::Layer:
            return {"layer", {box_vertex}, {shaders::blend, layer_fragment}};
        case Kind::Compose:
            return {"compose", {box_vertex}, {finishes, finishBlend, output, compose_fragment}};
        default:
            return {"blend", {box_vertex}, {shaders::blend, blend_fragment}};
    }
}

ProgramSource Programs::filterSource(FilterProgram program, FilterVariant variant) {
    using namespace shaders;
    const std::string constants = filterConstants() + fmt::format("const uint variant = {}u;\n", variant);
    switch (program) {
        case FilterProgram::Source:
            return {"filter source",
                    {screen_vertex},
                    {constants, shaders::blend, store, colors, source_fragment}};
        case FilterProgram::PerPixel:
            return {"filter per pixel",
                    {screen_vertex},
                    {constants, fetch, shaders::blend, shaders::layer, store, colors, numbers,
                     per_pixel_fragment}};
        case FilterProgram::Blur:
            return {"blur", {screen_vertex}, {constants, shaders::layer, store, blur_fragment}};
        case FilterProgram::Extreme:
            return {"morphology", {screen_vertex}, {constants, shaders::layer, store, extreme_fragment}};
        case FilterProgram::Move:
            return {"filter move",
                    {screen_vertex},
                    {constants, shaders::blend, shaders::layer, store, colors, move_fragment}};
        case FilterProgram::Convolve:
            return {"convolution",
                    {screen_vertex},
                    {constants, fetch, shaders::blend, shaders::layer, store, colors, numbers,
                     convolve_fragment}};
        case FilterProgram::Light:
            return {
                "lighting",
                {screen_vertex},
                {constants, fetch, shaders::blend, shaders::layer, store, colors, numbers, light_fragment}};
        case FilterProgram::Turbulence:
            return {"turbulence",
                    {screen_vertex},
                    {constants, shaders::blend, store, colors, turbulence_fragment}};
        default:
            return {"filter result",
                    {screen_vertex},
                    {constants, shaders::blend, shaders::layer, colors, result_fragment}};
    }
}

namespace {

std::vector<std::pair<FilterProgram, FilterVariant>> everyFilter() {
    using asset::FilterOp;
    std::vector<std::pair<FilterProgram, FilterVariant>> all;
    for (const FilterProgram program :
         {FilterProgram::Source, FilterProgram::Extreme, FilterProgram::Convolve, FilterProgram::Light,
          FilterProgram::Turbulence})
        all.emplace_back(program, 0);
    for (const FilterOp op :
         {FilterOp::Picture, FilterOp::Blend, FilterOp::ColorMatrix, FilterOp::ComponentTransfer,
          FilterOp::Composite, FilterOp::Flood, FilterOp::DropShadow, FilterOp::Merge})
        all.emplace_back(FilterProgram::PerPixel, FilterVariant(op));
    for (const FilterOp op : {FilterOp::Offset, FilterOp::Tile, FilterOp::DisplacementMap})
        all.emplace_back(FilterProgram::Move, FilterVariant(op));
    for (const BlurAction action : {BlurAction::Reduce, BlurAction::Kernel, BlurAction::Enlarge})
        all.emplace_back(FilterProgram::Blur, FilterVariant(action));
    for (const FilterVariant interpolates : {0u, 1u})
        all.emplace_back(FilterProgram::Result, interpolates);
    return all;
}

}  // namespace

ProgramSource idsSource() {
    using namespace shaders;
    return {"ids", {screen_vertex}, {fetch, id_fragment}};
}

std::vector<ProgramSource> Programs::everySource() {
    std::vector<ProgramSource> sources;
    const std::string materials = materialsSource({});
    const auto add = [&](Kind kind, unsigned features, unsigned finish) {
        const bool uses = Features(features).has(Features::Material);
        sources.push_back(source(kind, Features(features), Finish(finish), uses ? materials : ""));
    };
    constexpr unsigned allFeatures = Features::combinations - 1, allFinishes = Finish::combinations - 1;
    for (const Kind kind : {Kind::Solid, Kind::Pieces, Kind::Layer, Kind::Blend})
        add(kind, 0, 0);
    // Of long ramps, which only gradients know, those without and with everything else.
    std::vector<unsigned> featureSets{Features::Linear | Features::LongRamps, allFeatures};
    for (unsigned features = 0; features < Features::LongRamps; ++features)
        featureSets.push_back(features);
    for (const unsigned features : featureSets) {
        add(Kind::Fill, features, 0);
        add(Kind::Tile, features, 0);
        add(Kind::Tile, features, allFinishes);
    }
    sources.push_back(idsSource());
    for (const auto& [program, variant] : everyFilter())
        sources.push_back(filterSource(program, variant));
    for (unsigned finish = 0; finish <= allFinishes; ++finish) {
        add(Kind::Flat, 0, finish);
        add(Kind::Compose, 0, finish);
        add(Kind::Tile, 0, finish);
        add(Kind::Tile, allFeatures, finish);
        add(Kind::CrowdedTile, 0, finish);
        for (const Kind kind : {Kind::LongTile, Kind::TwoColorTile, Kind::LongTwoColorTile})
            add(kind, 0, finish);
        add(Kind::CrowdedTile, allFeatures, finish);
        for (const Kind kind : {Kind::PlainFlat, Kind::PlainTile, Kind::CrowdedPlainTile})
            for (const unsigned features : {0u, unsigned(Features::Radial)})
                for (const unsigned points : {0u, unsigned(Features::RampPoints)})
                    add(kind, features | points, finish);
    }
    return sources;
}

ProgramFigures Programs::figures() const {
    ProgramFigures figures;
    const auto count = [&](const Program& program) {
        ++figures.made;
        figures.compiled += program.compiled() ? 1 : 0;
    };
    for (const auto& [key, program] : programs_)
        count(program);
    for (const auto& [key, program] : filters_)
        count(program);
    return figures;
}

}  // namespace vtm::gl

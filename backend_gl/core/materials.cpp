#include "backend_gl/core/materials.hpp"

#include <regex>

#include <fmt/format.h>

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

}  // namespace vtm::gl

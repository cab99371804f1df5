/// \file
/// What a shader does, counted in the SPIR-V that the reference compiler makes of it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vtm::bench {

struct ShaderCost {
    int textures = 0;  ///< fetches and samples
    int instructions =
        0;  ///< arithmetic, comparisons, conversions, selections, conditional branches: each once whatever
            ///< its width. Not what only moves values (loads, stores, swizzles) or marks blocks

    ShaderCost operator+(const ShaderCost& o) const {
        return {textures + o.textures, instructions + o.instructions};
    }
    ShaderCost operator-(const ShaderCost& o) const {
        return {textures - o.textures, instructions - o.instructions};
    }
    ShaderCost operator*(int times) const { return {textures * times, instructions * times}; }
};

/// A module's functions, unoptimised, so that each is as it was written.
class CountedShader {
public:
    /// Both sides of every branch of a function and all that it calls. `times`: how often functions run for
    /// one call, by name, where that is not once: 0 leaves one out. Throws std::invalid_argument if the
    /// function or one named is absent.
    ShaderCost cost(const std::string& function, const std::map<std::string, int>& times = {}) const;

private:
    friend std::optional<CountedShader> countShader(const std::string& glsl);

    struct Function {
        ShaderCost own;
        std::vector<std::string> calls;
    };
    std::map<std::string, Function> functions_;
};

/// A fragment shader in GLSL ES 3.00. Nothing where glslangValidator is not installed or refuses it.
std::optional<CountedShader> countShader(const std::string& glsl);

}  // namespace vtm::bench

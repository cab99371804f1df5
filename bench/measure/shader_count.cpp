#include "bench/measure/shader_count.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/core.h>

namespace vtm::bench {
namespace {

/// Operations by their numbers in the SPIR-V specification, section 3.49.
enum Operation : std::uint32_t {
    OpName = 5,
    OpFunction = 54,
    OpFunctionEnd = 56,
    OpFunctionCall = 57,
    OpImageSampleFirst = 87,  // OpImageSampleImplicitLod ... OpImageDrefGather, OpImageFetch among them
    OpImageSampleLast = 97
};

/// Moves values or marks blocks: Line, FunctionParameter, Variable, Load, Store, CopyMemory, AccessChain and
/// its kin, VectorShuffle, Composite..., CopyObject, Image, Phi, merges, Label, Branch, Return, ReturnValue,
/// Unreachable, NoLine.
bool isFree(std::uint32_t op) {
    static constexpr std::uint32_t free[] = {0,  8,  55,  59,  61,  62,  63,  65,  66,  79,  80,  81,
                                             82, 83, 100, 245, 246, 247, 248, 249, 253, 254, 255, 317};
    return std::ranges::find(free, op) != std::end(free);
}

/// "pieceDistance(vi2;vf2;vf2;mf22;" is pieceDistance.
std::string plainName(const std::uint32_t* words, std::size_t count) {
    std::string name;
    for (std::size_t i = 0; i < count * 4; ++i) {
        const char c = char(words[i / 4] >> (8 * (i % 4)) & 0xFF);
        if (c == 0 || c == '(')
            break;
        name += c;
    }
    return name;
}

std::vector<std::uint32_t> compiled(const std::string& glsl) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / fmt::format("vtm_shader_{}", ::getpid());
    fs::create_directory(folder);
    const std::string source = (folder / "counted.frag").string(), binary = (folder / "counted.spv").string();
    std::ofstream(source) << glsl;
    std::vector<std::uint32_t> words;
    // -R: uniforms outside of blocks.
    const std::string command =
        fmt::format("glslangValidator -V -R --aml --amb -S frag -o {} {} > /dev/null 2>&1", binary, source);
    if (std::system(command.c_str()) == 0) {
        std::ifstream file(binary, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
            const auto byte = [&](std::size_t k) { return std::uint32_t(std::uint8_t(bytes[i + k])); };
            words.push_back(byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24);
        }
    }
    fs::remove_all(folder);
    return words;
}

}  // namespace

ShaderCost CountedShader::cost(const std::string& function, const std::map<std::string, int>& times) const {
    for (const auto& [name, count] : times)
        if (!functions_.contains(name))
            throw std::invalid_argument("the shader has no function " + name);
    const auto found = functions_.find(function);
    if (found == functions_.end())
        throw std::invalid_argument("the shader has no function " + function);
    ShaderCost sum = found->second.own;
    for (const std::string& callee : found->second.calls) {
        const auto often = times.find(callee);
        sum = sum + cost(callee, times) * (often == times.end() ? 1 : often->second);
    }
    return sum;
}

std::optional<CountedShader> countShader(const std::string& glsl) {
    // SPIR-V for Vulkan begins with ES 3.10, which is a superset.
    std::string text = glsl;
    const std::string version = "#version 300 es";
    if (const std::size_t at = text.find(version); at != text.npos)
        text.replace(at, version.size(), "#version 310 es");
    const std::vector<std::uint32_t> words = compiled(text);
    if (words.size() < 5)
        return std::nullopt;
    std::map<std::uint32_t, std::string> names;
    CountedShader counted;
    CountedShader::Function* function = nullptr;
    for (std::size_t at = 5; at < words.size();) {
        const std::uint32_t op = words[at] & 0xFFFF, length = words[at] >> 16;
        if (length == 0 || at + length > words.size())
            return std::nullopt;
        const std::uint32_t* operands = &words[at + 1];
        if (op == OpName)
            names[operands[0]] = plainName(operands + 1, length - 2);
        else if (op == OpFunction)
            function = &counted.functions_[names[operands[1]]];
        else if (op == OpFunctionEnd)
            function = nullptr;
        else if (function && op == OpFunctionCall)
            function->calls.push_back(names[operands[2]]);
        else if (function && op >= OpImageSampleFirst && op <= OpImageSampleLast)
            ++function->own.textures;
        else if (function && !isFree(op))
            ++function->own.instructions;
        at += length;
    }
    return counted;
}

}  // namespace vtm::bench

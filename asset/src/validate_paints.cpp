#include <algorithm>
#include <set>
#include <string_view>

#include <vtm/image/codec.hpp>
#include "asset/records.hpp"
#include "asset/src/validate.hpp"

namespace vtm::asset {

namespace {

bool isColor(const Texel& texel) {
    return std::ranges::all_of(texel, [](std::uint32_t bits) { return isShare(std::bit_cast<float>(bits)); });
}

bool areFinite(const std::array<float, 6>& numbers) {
    return std::ranges::all_of(numbers, [](float v) { return std::isfinite(v); });
}

/// Asset::data with, for each texel, how many gradient stops in order begin there: found once, so
/// that overlapping gradients of a hostile file cost nothing each.
struct Data {
    const AssetView& asset;
    std::vector<std::uint32_t> stopRuns;

    explicit Data(const AssetView& a) : asset(a), stopRuns(a.data.size() + 1) {
        for (std::size_t i = a.data.size(); i-- > 0;) {
            const float offset = stopOffset(i);
            if (!isShare(offset))
                continue;
            const bool goesOn = i + 1 < a.data.size() && stopRuns[i + 1] > 0 && offset <= stopOffset(i + 1);
            stopRuns[i] = goesOn ? stopRuns[i + 1] + 1 : 1;
        }
    }
    float stopOffset(std::size_t texel) const { return std::bit_cast<float>(asset.data[texel][0]); }
    bool holds(std::size_t first, std::size_t count) const {
        return first <= asset.data.size() && count <= asset.data.size() - first;
    }
};

void validateGradient(const Data& data, std::size_t texel) {
    constexpr std::size_t head = sizeof(Gradient) / sizeof(Texel);
    require(data.holds(texel, head), "data", texel, "gradient is out of bounds");
    const auto g = recordAt<Gradient>(data.asset.data, texel);
    require(areFinite(g.matrix), "data", texel, "gradient's matrix is not finite");
    require(g.spread <= Spread::Repeat, "data", texel, "gradient's spread is unknown");
    require(std::isfinite(g.fx) && std::isfinite(g.fy) && std::isfinite(g.fr) && g.fr >= 0, "data", texel,
            "gradient's focal circle is out of range");
    require(g.stopCount >= 1, "data", texel, "gradient has no stops");
    require(data.holds(texel + head, g.stopCount), "data", texel, "gradient's stops are out of bounds");
    require(g.stopCount <= data.stopRuns[texel + head], "data", texel,
            "gradient's stops are not in order in [0, 1]");
}

void validateImageFill(const Data& data, std::size_t texel) {
    require(data.holds(texel, sizeof(ImageFill) / sizeof(Texel)), "data", texel,
            "image fill is out of bounds");
    const auto fill = recordAt<ImageFill>(data.asset.data, texel);
    require(areFinite(fill.matrix), "data", texel, "image fill's matrix is not finite");
    require(fill.image < data.asset.images.size(), "data", texel, "image fill refers to a missing image");
    require(fill.filter <= ImageFilter::Bicubic, "data", texel, "image fill's filter is unknown");
}

void validateMaterialFill(const Data& data, std::size_t texel) {
    require(data.holds(texel, sizeof(MaterialFill) / sizeof(Texel)), "data", texel,
            "material fill is out of bounds");
    const auto fill = recordAt<MaterialFill>(data.asset.data, texel);
    require(areFinite(fill.matrix), "data", texel, "material fill's matrix is not finite");
    require(fill.material < data.asset.materials.size(), "data", texel,
            "material fill refers to a missing material");
    require(fill.unused == 0, "data", texel, "material fill's unused word is not zero");
    require(std::ranges::all_of(fill.fallback, isShare), "data", texel,
            "material fill's fallback colour is out of range");
}

void validateLayer(const Data& data, const Instruction& in) {
    switch (in.op) {
        case Op::Solid:
            require(data.holds(in.argument, 1), "data", in.argument, "colour is out of bounds");
            return require(isColor(data.asset.data[in.argument]), "data", in.argument,
                           "colour is out of range");
        case Op::Image:
            return validateImageFill(data, in.argument);
        case Op::Material:
            return validateMaterialFill(data, in.argument);
        default:
            return validateGradient(data, in.argument);
    }
}

/// Depth of the stack after an instruction.
unsigned depthAfter(const Instruction& in, unsigned depth, std::size_t paint) {
    if (in.op == Op::Push) {
        require(depth < maxStack, "paints", paint, "program overflows its stack");
        return depth + 1;
    }
    if (in.op >= Op::Solid)
        return depth;
    require(depth > 1, "paints", paint, "program pops an empty stack");
    return depth - 1;
}

void validateProgram(const Data& data, std::size_t index) {
    const Paint& paint = data.asset.paints[index];
    require(paint[2] == 0, "paints", index, "unused word is not zero");
    require(paint[1] <= maxInstructions, "paints", index, "program is too long");
    require(data.holds(paint[0], paint[1]), "paints", index, "program is out of bounds");
    unsigned depth = 1;
    for (std::uint32_t i = 0; i < paint[1]; ++i) {
        const auto in = recordAt<Instruction>(data.asset.data, paint[0] + i);
        require(in.op <= Op::Material, "paints", index, "operation is unknown");
        require(in.blend <= Blend::PlusLighter, "paints", index, "blend mode is unknown");
        require(isShare(in.opacity), "paints", index, "opacity is out of range");
        if (in.op >= Op::Solid)
            validateLayer(data, in);
        depth = depthAfter(in, depth, index);
    }
    require(depth == 1, "paints", index, "program does not close a group");
}

void validateImages(const AssetView& asset) {
    std::int64_t pixels = 0;
    for (std::size_t i = 0; i < asset.images.size(); ++i) {
        const image::Bitmap& bitmap = asset.images[i];
        require(bitmap.width > 0 && bitmap.height > 0, "images", i, "picture is empty");
        pixels += std::int64_t(bitmap.width) * bitmap.height;
        require(pixels <= image::maxDecodedPixels, "images", i, "pictures have too many pixels");
        require(std::int64_t(bitmap.rgba.size()) == std::int64_t(bitmap.width) * bitmap.height * 4, "images",
                i, "bytes do not match the size");
    }
}

/// What GLSL leaves to its users: no leading gl_, no double underscore (GLSL ES 3.00 section 3.8).
bool isMaterialName(const std::string& name) {
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto isRest = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; };
    return !name.empty() && name.size() <= maxMaterialName && isLetter(name[0]) &&
           std::ranges::all_of(name, isRest) && name.find("__") == std::string::npos &&
           !name.starts_with("gl_");
}

void validateMaterials(const AssetView& asset) {
    require(asset.materials.size() <= maxMaterials, "materials", maxMaterials, "there are too many");
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < asset.materials.size(); ++i) {
        const Material& material = asset.materials[i];
        require(isMaterialName(material.name), "materials", i, "name is not a plain identifier");
        require(names.insert(material.name).second, "materials", i, "name is used twice");
        require(material.glsl.size() <= maxMaterialText && material.glsl.find('\0') == std::string::npos,
                "materials", i, "text holds a zero byte or is too long");
    }
}

}  // namespace

void validatePaints(const AssetView& asset) {
    validateImages(asset);
    validateMaterials(asset);
    require(!asset.paints.empty() && asset.paints[0] == Paint{}, "paints", 0, "must be transparent");
    // Each command that draws a map may say where its paints begin.
    require(asset.paints.size() <= 65536 || !asset.filters.empty(), "paints", 65536,
            "index needs more than 16 bits");
    const Data data(asset);
    for (std::size_t i = 0; i < asset.paints.size(); ++i)
        if (isProgram(asset.paints[i]))
            validateProgram(data, i);
        else
            require(isColor(asset.paints[i]), "paints", i, "colour is out of range");
}

}  // namespace vtm::asset

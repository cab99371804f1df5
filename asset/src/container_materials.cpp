#include "asset/src/container_materials.hpp"

#include "asset/src/validate.hpp"

namespace vtm::asset {

CodedMaterials encodeMaterials(std::span<const Material> materials) {
    CodedMaterials coded;
    for (const Material& m : materials) {
        coded.table.push_back({std::uint32_t(m.name.size()), std::uint32_t(m.glsl.size()), 0});
        coded.bytes.insert(coded.bytes.end(), m.name.begin(), m.name.end());
        coded.bytes.insert(coded.bytes.end(), m.glsl.begin(), m.glsl.end());
    }
    return coded;
}

std::vector<Material> decodeMaterials(std::span<const MaterialRecord> table,
                                      std::span<const std::uint8_t> bytes) {
    std::vector<Material> materials;
    std::size_t next = 0;
    const auto take = [&](std::size_t count) {
        require(count <= bytes.size() - next, "materials", materials.size(), "text ends early");
        const auto text = bytes.subspan(next, count);
        next += count;
        return std::string(text.begin(), text.end());
    };
    for (const MaterialRecord& record : table) {
        require(record.unused == 0, "materials", materials.size(), "unused word is not zero");
        Material material;
        material.name = take(record.nameBytes);
        material.glsl = take(record.textBytes);
        materials.push_back(std::move(material));
    }
    require(next == bytes.size(), "materials", table.size(), "there are unused bytes");
    return materials;
}

}  // namespace vtm::asset

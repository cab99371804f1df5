#include <cstring>

#include <vtm/asset/container.hpp>
#include "asset/src/container_layout.hpp"

namespace vtm::asset {

namespace {

/// A section that waits to be written: the bytes of its records.
struct Pending {
    SectionLine line;
    std::span<const std::uint8_t> bytes;
};

template <class Record>
Pending section(SectionKind kind, std::span<const Record> records) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(records.data()), records.size_bytes());
    return {{kind, sizeof(Record), 0, records.size(), checksumOf(bytes), 0}, bytes};
}

template <class Record>
void put(std::vector<std::uint8_t>& file, std::size_t offset, const Record& record) {
    std::memcpy(&file[offset], &record, sizeof record);
}

std::vector<std::uint8_t> assemble(std::vector<Pending>& sections) {
    const std::size_t tableEnd = sizeof(FileHeader) + sections.size() * sizeof(SectionLine);
    std::uint64_t end = alignedOffset(tableEnd);
    for (Pending& s : sections) {
        s.line.offset = end;
        end = alignedOffset(end + s.bytes.size());
    }
    std::vector<std::uint8_t> file(end);
    for (std::size_t i = 0; i < sections.size(); ++i) {
        put(file, sizeof(FileHeader) + i * sizeof(SectionLine), sections[i].line);
        std::ranges::copy(sections[i].bytes, file.begin() + std::ptrdiff_t(sections[i].line.offset));
    }
    FileHeader header{fileMagic, fileVersion, endianMark, end, std::uint32_t(sections.size()), 0};
    put(file, 0, header);
    header.checksum = headerChecksum(file, tableEnd);
    put(file, 0, header);
    return file;
}

}  // namespace

std::vector<std::uint8_t> write(const AssetView& asset) {
    validate(asset);
    const PictureRecord picture{asset.width, asset.height, asset.mode, asset.fallbackLeaves,
                                asset.prefilter.size};
    const CodedImages images = encodeImages(asset.images);
    const CodedMaterials materials = encodeMaterials(asset.materials);
    std::vector<Pending> sections{section(SectionKind::Picture, std::span(&picture, 1)),
                                  section(SectionKind::Maps, asset.maps),
                                  section(SectionKind::Commands, asset.commands),
                                  section(SectionKind::Nodes, asset.nodes),
                                  section(SectionKind::Leaves, asset.leaves),
                                  section(SectionKind::Pieces, asset.pieces),
                                  section(SectionKind::Paints, asset.paints),
                                  section(SectionKind::Data, asset.data),
                                  section(SectionKind::Images, std::span(images.table)),
                                  section(SectionKind::ImageBytes, std::span(images.bytes))};
    if (!asset.prefilter.texels.empty())
        sections.push_back(section(SectionKind::Prefilter, asset.prefilter.texels));
    if (!materials.table.empty()) {
        sections.push_back(section(SectionKind::Materials, std::span(materials.table)));
        sections.push_back(section(SectionKind::MaterialBytes, std::span(materials.bytes)));
    }
    const auto addUnlessEmpty = [&](SectionKind kind, auto records) {
        if (!records.empty())
            sections.push_back(section(kind, records));
    };
    addUnlessEmpty(SectionKind::InstanceTrees, asset.instanceTrees);
    addUnlessEmpty(SectionKind::Instances, asset.instances);
    addUnlessEmpty(SectionKind::Symbols, asset.symbols);
    addUnlessEmpty(SectionKind::Palettes, asset.palettes);
    addUnlessEmpty(SectionKind::Filters, asset.filters);
    addUnlessEmpty(SectionKind::FilterPrimitives, asset.filterPrimitives);
    addUnlessEmpty(SectionKind::FilterWords, asset.filterWords);
    const AccuracyRecord accuracy{asset.finestPixel.value_or(0)};
    if (asset.finestPixel)
        sections.push_back(section(SectionKind::Accuracy, std::span(&accuracy, 1)));
    if (asset.font)
        sections.push_back(section(SectionKind::Font, std::span(&*asset.font, 1)));
    addUnlessEmpty(SectionKind::Glyphs, asset.glyphs);
    addUnlessEmpty(SectionKind::GlyphParts, asset.glyphParts);
    const DrawnFiltersRecord drawnFilters{asset.filterPixels};
    if (asset.filterPixels != 0)
        sections.push_back(section(SectionKind::DrawnFilters, std::span(&drawnFilters, 1)));
    return assemble(sections);
}

}  // namespace vtm::asset

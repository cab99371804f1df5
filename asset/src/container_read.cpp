#include "asset/src/container_layout.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "asset/src/validate.hpp"

namespace vtm::asset {

namespace {

using Bytes = std::span<const std::uint8_t>;

void requireAt(bool holds, std::uint64_t offset, std::string_view what) {
    if (!holds)
        throw FormatError(fmt::format("offset {}: {}", offset, what));
}

template <class Record>
Record load(Bytes bytes, std::size_t offset) {
    Record record;
    std::memcpy(&record, bytes.data() + offset, sizeof record);
    return record;
}

std::size_t lineOffset(std::size_t i) { return sizeof(FileHeader) + i * sizeof(SectionLine); }

FileHeader checkedHeader(Bytes bytes) {
    requireAt(bytes.size() >= sizeof(FileHeader), bytes.size(), "file ends inside its header");
    const auto header = load<FileHeader>(bytes, 0);
    requireAt(header.magic == fileMagic, 0, "not a .vtm file");
    requireAt(header.endian == endianMark, offsetof(FileHeader, endian), "byte order is not little-endian");
    requireAt(header.version == fileVersion, offsetof(FileHeader, version),
              fmt::format("version {} is unknown; this reader knows {}", header.version, fileVersion));
    requireAt(header.fileBytes == bytes.size(), offsetof(FileHeader, fileBytes),
              fmt::format("file has {} bytes instead of {}", bytes.size(), header.fileBytes));
    requireAt(header.sections <= maxSections, offsetof(FileHeader, sections),
              "number of sections is too large");
    requireAt(bytes.size() >= lineOffset(header.sections), bytes.size(),
              "file ends inside its section table");
    requireAt(header.checksum == headerChecksum(bytes, lineOffset(header.sections)),
              offsetof(FileHeader, checksum), "checksum of header and section table does not match");
    return header;
}

/// The table's lines, each held against the end of the section before: so none overlap, none reach beyond
/// the file, and between and behind them stand only the zeros that fill them up.
std::vector<SectionLine> checkedTable(Bytes bytes) {
    const FileHeader header = checkedHeader(bytes);
    std::uint64_t next = lineOffset(header.sections);
    const auto skipPadding = [&] {
        const std::uint64_t end = next;
        next = alignedOffset(end);
        requireAt(next <= bytes.size(), end, "file ends inside padding");
        for (std::uint64_t i = end; i < next; ++i)
            requireAt(bytes[i] == 0, i, "padding is not zero");
    };
    skipPadding();
    std::vector<SectionLine> lines;
    for (std::size_t i = 0; i < header.sections; ++i) {
        const auto line = load<SectionLine>(bytes, lineOffset(i));
        const auto check = [&](bool holds, std::string_view what) {
            requireAt(holds, lineOffset(i), fmt::format("section {}: {}", nameOf(line.kind), what));
        };
        check(lines.empty() || lines.back().kind < line.kind, "kinds do not ascend");
        check(line.unused == 0, "unused word is not zero");
        check(line.recordBytes > 0, "records have no size");
        check(line.offset == next, "does not begin where the section before ends");
        check(line.count <= (bytes.size() - next) / line.recordBytes, "reaches beyond the end of the file");
        next += line.count * line.recordBytes;
        skipPadding();
        lines.push_back(line);
    }
    requireAt(next == bytes.size(), next, "there are bytes after the last section");
    return lines;
}

Bytes bytesOf(Bytes file, const SectionLine& line) {
    return file.subspan(line.offset, line.count * line.recordBytes);
}

class Sections {
public:
    explicit Sections(Bytes file) : file_(file), lines_(checkedTable(file)) {
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const SectionLine& line = lines_[i];
            const bool known = line.kind <= lastKnown;
            const bool ignorable = (std::uint32_t(line.kind) & ignorableBit) != 0;
            requireAt(known || ignorable, lineOffset(i),
                      fmt::format("section {}: kind is unknown", nameOf(line.kind)));
            requireAt(line.checksum == checksumOf(bytesOf(file, line)), line.offset,
                      fmt::format("section {}: checksum does not match", nameOf(line.kind)));
        }
    }

    /// The records where they lie; none if an optional section is absent.
    template <class Record>
    std::span<const Record> take(SectionKind kind) const {
        const auto line = std::ranges::find(lines_, kind, &SectionLine::kind);
        if (line == lines_.end()) {
            requireAt(kind > lastRequired, sizeof(FileHeader),
                      fmt::format("section {}: is missing", nameOf(kind)));
            return {};
        }
        const std::size_t where = lineOffset(std::size_t(line - lines_.begin()));
        requireAt(line->recordBytes == sizeof(Record), where,
                  fmt::format("section {}: size of its records is {}, not {}", nameOf(kind),
                              line->recordBytes, sizeof(Record)));
        requireAt(kind <= lastRequired || line->count > 0, where,
                  fmt::format("section {}: is empty and should be left out", nameOf(kind)));
        return {reinterpret_cast<const Record*>(file_.data() + line->offset), std::size_t(line->count)};
    }

private:
    Bytes file_;
    std::vector<SectionLine> lines_;
};

void readPicture(const Sections& sections, AssetView& view) {
    const auto records = sections.take<PictureRecord>(SectionKind::Picture);
    asset::require(records.size() == 1, "picture", records.size(), "must be one record");
    view.width = records[0].width;
    view.height = records[0].height;
    view.mode = records[0].mode;
    view.fallbackLeaves = records[0].fallbackLeaves;
    view.prefilter.size = records[0].prefilter;
}

void readAccuracy(const Sections& sections, AssetView& view) {
    const auto records = sections.take<AccuracyRecord>(SectionKind::Accuracy);
    if (records.empty())
        return;
    asset::require(records.size() == 1, "accuracy", records.size(), "must be one record");
    asset::require(records[0].unused == 0, "accuracy", 0, "unused word is not zero");
    view.finestPixel = records[0].finestPixel;
}

void readDrawnFilters(const Sections& sections, AssetView& view) {
    const auto records = sections.take<DrawnFiltersRecord>(SectionKind::DrawnFilters);
    if (records.empty())
        return;
    asset::require(records.size() == 1, "drawn filters", records.size(), "must be one record");
    asset::require(std::ranges::count(records[0].unused, 0u) == 3, "drawn filters", 0,
                   "unused word is not zero");
    view.filterPixels = records[0].pixels;
}

void readFont(const Sections& sections, AssetView& view) {
    const auto records = sections.take<Font>(SectionKind::Font);
    asset::require(records.size() <= 1, "font", records.size(), "must be one record");
    if (!records.empty())
        view.font = records[0];
    view.glyphs = sections.take<Glyph>(SectionKind::Glyphs);
    view.glyphParts = sections.take<GlyphPart>(SectionKind::GlyphParts);
}

}  // namespace

Contents openContents(Bytes bytes) {
    const Sections sections(bytes);
    Contents contents;
    AssetView& view = contents.view;
    readPicture(sections, view);
    view.maps = sections.take<Map>(SectionKind::Maps);
    view.commands = sections.take<Command>(SectionKind::Commands);
    view.nodes = sections.take<Node>(SectionKind::Nodes);
    view.leaves = sections.take<Leaf>(SectionKind::Leaves);
    view.pieces = sections.take<Piece>(SectionKind::Pieces);
    view.paints = sections.take<Paint>(SectionKind::Paints);
    view.data = sections.take<Texel>(SectionKind::Data);
    view.prefilter.texels = sections.take<Rgba8>(SectionKind::Prefilter);
    contents.images = decodeImages(sections.take<ImageRecord>(SectionKind::Images),
                                   sections.take<std::uint8_t>(SectionKind::ImageBytes));
    view.images = contents.images;
    contents.materials = decodeMaterials(sections.take<MaterialRecord>(SectionKind::Materials),
                                         sections.take<std::uint8_t>(SectionKind::MaterialBytes));
    view.materials = contents.materials;
    view.instanceTrees = sections.take<InstanceTree>(SectionKind::InstanceTrees);
    view.instances = sections.take<Instance>(SectionKind::Instances);
    view.symbols = sections.take<Symbol>(SectionKind::Symbols);
    view.palettes = sections.take<std::uint16_t>(SectionKind::Palettes);
    view.filters = sections.take<Filter>(SectionKind::Filters);
    view.filterPrimitives = sections.take<FilterPrimitive>(SectionKind::FilterPrimitives);
    view.filterWords = sections.take<std::uint32_t>(SectionKind::FilterWords);
    readAccuracy(sections, view);
    readFont(sections, view);
    readDrawnFilters(sections, view);
    validate(view);
    return contents;
}

Asset read(Bytes bytes) {
    std::vector<Texel> moved;
    if (reinterpret_cast<std::uintptr_t>(bytes.data()) % recordAlignment != 0) {
        static_assert(sizeof(Texel) == recordAlignment);  // and new aligns to as much
        moved.resize((bytes.size() + sizeof(Texel) - 1) / sizeof(Texel));
        std::memcpy(moved.data(), bytes.data(), bytes.size());
        bytes = {reinterpret_cast<const std::uint8_t*>(moved.data()), bytes.size()};
    }
    Contents contents = openContents(bytes);
    contents.view.images = {};
    contents.view.materials = {};
    Asset asset = toAsset(contents.view);
    asset.images = std::move(contents.images);
    asset.materials = std::move(contents.materials);
    return asset;
}

bool isContainer(Bytes bytes) {
    return bytes.size() >= telltaleBytes &&
           std::equal(fileMagic.begin(), fileMagic.begin() + telltaleBytes, bytes.begin());
}

std::vector<SectionInfo> sectionsOf(Bytes bytes) {
    std::vector<SectionInfo> sections;
    for (const SectionLine& line : checkedTable(bytes))
        sections.push_back({nameOf(line.kind), line.offset, line.recordBytes, line.count, line.checksum,
                            checksumOf(bytesOf(bytes, line))});
    return sections;
}

}  // namespace vtm::asset

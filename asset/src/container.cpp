#include "asset/container.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "asset/src/container_images.hpp"
#include "asset/src/container_materials.hpp"

namespace vtm::asset {

namespace {

// Sections are the records themselves; a big-endian machine would have to swap every word.
static_assert(std::endian::native == std::endian::little);

using Bytes = std::span<const std::uint8_t>;

/// A carriage return, a line feed and DOS's end of file: transfers as text damage it visibly.
constexpr std::array<std::uint8_t, 8> magic{'V', 'T', 'M', 0xB6, '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t currentVersion = 1;
constexpr std::uint32_t endianMark = 0x01020304;
/// Where sections begin: a texel's size.
constexpr std::size_t alignment = 16;

struct Header {
    std::array<std::uint8_t, 8> magic{};
    std::uint32_t version = 0, endian = 0;
    std::uint64_t fileBytes = 0;
    std::uint32_t sections = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of all bytes after the header
};
static_assert(sizeof(Header) == 32);

enum class Kind : std::uint32_t {
    Picture,
    Maps,
    Commands,
    Nodes,
    Leaves,
    Pieces,
    Paints,
    Data,
    Images,
    ImageBytes,
    Materials,
    MaterialBytes
};
constexpr std::array<std::string_view, 12> sectionNames{
    "picture", "maps", "commands", "nodes",       "leaves",    "pieces",
    "paints",  "data", "images",   "image bytes", "materials", "material bytes"};

/// A line of the section table, one for each kind, in order.
struct Section {
    Kind kind = Kind::Picture;
    std::uint32_t recordBytes = 0;
    std::uint64_t offset = 0, count = 0, unused = 0;
};
static_assert(sizeof(Section) == 32);

struct PictureRecord {
    double width = 0, height = 0;
    Mode mode = Mode::Exact;
    std::uint32_t fallbackLeaves = 0;
    std::array<std::uint32_t, 2> unused{};
};
struct MapRecord {
    double x = 0, y = 0, side = 0;
    Entry root;
    std::uint32_t unused = 0;
};
struct CommandRecord {
    Command command;
    std::array<std::uint32_t, 3> unused{};
};
static_assert(sizeof(PictureRecord) == 32 && sizeof(MapRecord) == 32 && sizeof(CommandRecord) == 32);

constexpr std::size_t firstSection = sizeof(Header) + sectionNames.size() * sizeof(Section);

std::size_t aligned(std::size_t offset) { return (offset + alignment - 1) / alignment * alignment; }

std::uint32_t checksumOf(Bytes bytes) {
    uLong sum = crc32(0, nullptr, 0);
    return std::uint32_t(crc32_z(sum, bytes.data(), bytes.size()));
}

// ---- Writing --------------------------------------------------------------------------------------

class Writer {
public:
    Writer() : bytes_(firstSection) {}

    template <class Record>
    void add(Kind kind, const std::vector<Record>& records) {
        const Section section{kind, sizeof(Record), bytes_.size(), records.size(), 0};
        std::memcpy(&bytes_[sizeof(Header) + std::size_t(kind) * sizeof section], &section, sizeof section);
        bytes_.resize(aligned(section.offset + records.size() * sizeof(Record)));
        if (!records.empty())
            std::memcpy(&bytes_[section.offset], records.data(), records.size() * sizeof(Record));
    }

    std::vector<std::uint8_t> finish() {
        Header header{magic, currentVersion, endianMark, bytes_.size(), std::uint32_t(sectionNames.size()),
                      0};
        header.checksum = checksumOf(Bytes(bytes_).subspan(sizeof header));
        std::memcpy(bytes_.data(), &header, sizeof header);
        return std::move(bytes_);
    }

private:
    std::vector<std::uint8_t> bytes_;
};

std::vector<MapRecord> mapRecords(const Asset& asset) {
    std::vector<MapRecord> records;
    for (const Map& map : asset.maps)
        records.push_back({map.x, map.y, map.side, map.root, 0});
    return records;
}

std::vector<CommandRecord> commandRecords(const Asset& asset) {
    std::vector<CommandRecord> records;
    for (const Command& command : asset.commands)
        records.push_back({command, {}});
    return records;
}

// ---- Reading --------------------------------------------------------------------------------------

void require(bool holds, std::size_t offset, std::string_view what) {
    if (!holds)
        throw FormatError(fmt::format("offset {}: {}", offset, what));
}

template <class Record>
Record load(Bytes bytes, std::size_t offset) {
    Record record;
    std::memcpy(&record, bytes.data() + offset, sizeof record);
    return record;
}

void checkHeader(Bytes bytes) {
    require(bytes.size() >= firstSection, bytes.size(), "file ends inside its header");
    const auto header = load<Header>(bytes, 0);
    require(header.magic == magic, 0, "not a .vtm file");
    require(header.version == currentVersion, offsetof(Header, version),
            fmt::format("version {} is unknown", header.version));
    require(header.endian == endianMark, offsetof(Header, endian), "byte order is not little-endian");
    require(header.fileBytes == bytes.size(), offsetof(Header, fileBytes),
            fmt::format("file should have {} bytes and has {}", header.fileBytes, bytes.size()));
    require(header.sections == sectionNames.size(), offsetof(Header, sections),
            "number of sections is wrong");
    require(header.checksum == checksumOf(bytes.subspan(sizeof header)), offsetof(Header, checksum),
            "checksum does not match");
}

class Reader {
public:
    explicit Reader(Bytes bytes) : bytes_(bytes) { checkHeader(bytes); }

    /// Sections are read in order, so that each can be held against the end of the one before.
    template <class Record>
    std::vector<Record> take(Kind kind) {
        const std::size_t line = sizeof(Header) + std::size_t(kind) * sizeof(Section);
        const auto section = load<Section>(bytes_, line);
        const auto check = [&](bool holds, std::string_view what) {
            require(holds, line, fmt::format("section {}: {}", sectionNames[std::size_t(kind)], what));
        };
        check(section.kind == kind, "not in its place");
        check(section.recordBytes == sizeof(Record), "size of its records is wrong");
        check(section.unused == 0, "unused word is not zero");
        check(section.offset == next_, "does not follow the section before");
        check(section.count <= (bytes_.size() - next_) / sizeof(Record), "reaches beyond the end");
        std::vector<Record> records(section.count);
        if (!records.empty())
            std::memcpy(records.data(), bytes_.data() + next_, records.size() * sizeof(Record));
        skip(records.size() * sizeof(Record));
        return records;
    }

    void finish() const { require(next_ == bytes_.size(), next_, "bytes are left over"); }

private:
    /// Past a section and the zeros up to the next.
    void skip(std::size_t size) {
        const std::size_t end = next_ + size;
        next_ = aligned(end);
        require(next_ <= bytes_.size(), end, "file ends inside padding");
        for (std::size_t i = end; i < next_; ++i)
            require(bytes_[i] == 0, i, "padding is not zero");
    }

    Bytes bytes_;
    std::size_t next_ = firstSection;
};

void readPicture(Reader& reader, Asset& asset) {
    const auto records = reader.take<PictureRecord>(Kind::Picture);
    require(records.size() == 1, firstSection, "section picture: must have one record");
    const PictureRecord& picture = records[0];
    require(picture.unused == decltype(picture.unused){}, firstSection,
            "section picture: unused words are not zero");
    asset.width = picture.width;
    asset.height = picture.height;
    asset.mode = picture.mode;
    asset.fallbackLeaves = picture.fallbackLeaves;
}

void readMaps(Reader& reader, Asset& asset) {
    for (const MapRecord& record : reader.take<MapRecord>(Kind::Maps)) {
        if (record.unused != 0)
            throw FormatError(fmt::format("maps[{}]: unused word is not zero", asset.maps.size()));
        asset.maps.push_back({record.x, record.y, record.side, record.root});
    }
}

void readCommands(Reader& reader, Asset& asset) {
    for (const CommandRecord& record : reader.take<CommandRecord>(Kind::Commands)) {
        if (record.unused != decltype(record.unused){})
            throw FormatError(fmt::format("commands[{}]: unused words are not zero", asset.commands.size()));
        asset.commands.push_back(record.command);
    }
}

}  // namespace

std::vector<std::uint8_t> write(const Asset& asset) {
    const CodedImages images = encodeImages(asset.images);
    const CodedMaterials materials = encodeMaterials(asset.materials);
    Writer writer;
    writer.add(Kind::Picture,
               std::vector{PictureRecord{asset.width, asset.height, asset.mode, asset.fallbackLeaves, {}}});
    writer.add(Kind::Maps, mapRecords(asset));
    writer.add(Kind::Commands, commandRecords(asset));
    writer.add(Kind::Nodes, asset.nodes);
    writer.add(Kind::Leaves, asset.leaves);
    writer.add(Kind::Pieces, asset.pieces);
    writer.add(Kind::Paints, asset.paints);
    writer.add(Kind::Data, asset.data);
    writer.add(Kind::Images, images.table);
    writer.add(Kind::ImageBytes, images.bytes);
    writer.add(Kind::Materials, materials.table);
    writer.add(Kind::MaterialBytes, materials.bytes);
    return writer.finish();
}

Asset read(std::span<const std::uint8_t> bytes) {
    Reader reader(bytes);
    Asset asset;
    readPicture(reader, asset);
    readMaps(reader, asset);
    readCommands(reader, asset);
    asset.nodes = reader.take<Node>(Kind::Nodes);
    asset.leaves = reader.take<Leaf>(Kind::Leaves);
    asset.pieces = reader.take<Piece>(Kind::Pieces);
    asset.paints = reader.take<Paint>(Kind::Paints);
    asset.data = reader.take<Texel>(Kind::Data);
    const auto table = reader.take<ImageRecord>(Kind::Images);
    const auto imageBytes = reader.take<std::uint8_t>(Kind::ImageBytes);
    const auto materials = reader.take<MaterialRecord>(Kind::Materials);
    const auto materialBytes = reader.take<std::uint8_t>(Kind::MaterialBytes);
    reader.finish();
    asset.images = decodeImages(table, imageBytes);
    asset.materials = decodeMaterials(materials, materialBytes);
    validate(asset);
    return asset;
}

}  // namespace vtm::asset

#include "svg/xml/decode.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>

#include <vtm/limits/limits.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// zlib's inflater, freed on every way out.
struct Inflater {
    z_stream stream{};

    Inflater() {
        constexpr int gzipOnly = 16 + MAX_WBITS;
        inflateInit2(&stream, gzipOnly);
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { inflateEnd(&stream); }
};

std::vector<std::uint8_t> gunzip(Bytes bytes, const std::string& fileName) {
    Inflater inflater;
    z_stream& stream = inflater.stream;
    stream.next_in = const_cast<std::uint8_t*>(bytes.data());
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::vector<std::uint8_t> out;
    std::array<std::uint8_t, 1 << 16> chunk;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        limits::check();
        stream.next_out = chunk.data();
        stream.avail_out = static_cast<uInt>(chunk.size());
        status = inflate(&stream, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END)
            throw ParseError({fileName}, "the gzip data is corrupt");
        out.insert(out.end(), chunk.begin(), chunk.end() - static_cast<std::ptrdiff_t>(stream.avail_out));
        if (out.size() > Limits::maxBytes)
            throw ParseError({fileName}, "the unpacked file is too large");
    }
    return out;
}

void appendUtf8(std::string& out, char32_t c) {
    const auto byte = [&](char32_t value) { out.push_back(static_cast<char>(value)); };
    if (c < 0x80) {
        byte(c);
    } else if (c < 0x800) {
        byte(0xc0 | c >> 6);
        byte(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
        byte(0xe0 | c >> 12);
        byte(0x80 | (c >> 6 & 0x3f));
        byte(0x80 | (c & 0x3f));
    } else {
        byte(0xf0 | c >> 18);
        byte(0x80 | (c >> 12 & 0x3f));
        byte(0x80 | (c >> 6 & 0x3f));
        byte(0x80 | (c & 0x3f));
    }
}

std::string fromUtf16(Bytes bytes, bool bigEndian) {
    const auto unit = [&](std::size_t i) {
        const char32_t first = bytes[i], second = bytes[i + 1];
        return bigEndian ? first << 8 | second : second << 8 | first;
    };
    std::string out;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        limits::check();
        char32_t c = unit(i);
        const bool pair = c >= 0xd800 && c < 0xdc00 && i + 3 < bytes.size();
        if (const char32_t low = pair ? unit(i + 2) : 0; low >= 0xdc00 && low < 0xe000) {
            c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
            i += 2;
        }
        appendUtf8(out, c);
    }
    return out;
}

/// The name after `encoding=` in the XML declaration, empty if there is none.
std::string_view declaredEncoding(std::string_view text) {
    if (!text.starts_with("<?xml"))
        return {};
    const std::string_view declaration = text.substr(0, text.find("?>"));
    const std::size_t at = declaration.find("encoding");
    if (at == declaration.npos)
        return {};
    Cursor cursor(declaration.substr(at + 8));
    cursor.skipSpaces();
    cursor.consume('=');
    cursor.skipSpaces();
    return cursor.consume('"')    ? cursor.until('"')
           : cursor.consume('\'') ? cursor.until('\'')
                                  : std::string_view{};
}

bool isWestern(std::string_view encoding) {
    constexpr std::array<std::string_view, 5> names{"iso-8859-1", "iso-8859-15", "latin1", "windows-1252",
                                                    "cp1252"};
    return std::any_of(names.begin(), names.end(),
                       [&](auto name) { return equalsIgnoringCase(name, encoding); });
}

std::string fromLatin1(std::string_view text) {
    std::string out;
    for (const char c : text)
        appendUtf8(out, static_cast<unsigned char>(c));
    return out;
}

}  // namespace

std::string decodeText(Bytes bytes, const std::string& fileName) {
    if (bytes.size() > Limits::maxBytes)
        throw ParseError({fileName}, "the file is too large");
    std::vector<std::uint8_t> unpacked;
    if (bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b) {
        unpacked = gunzip(bytes, fileName);
        bytes = unpacked;
    }
    if (bytes.size() >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff)
        return fromUtf16(bytes.subspan(2), true);
    if (bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe)
        return fromUtf16(bytes.subspan(2), false);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    return isWestern(declaredEncoding(text)) ? fromLatin1(text) : std::string(text);
}

}  // namespace vtm::svg

#include "svg/xml/decode.hpp"

#include <iconv.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <unordered_map>

#include <vtm/limits/limits.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {

void appendUtf8(std::string& out, char32_t c) {
    constexpr char32_t lastCharacter = 0x10ffff, replacement = 0xfffd;
    if (c == 0 || c > lastCharacter)
        c = replacement;
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

// ---- Bytes --------------------------------------------------------------------------------------

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

/// Frees the converter on every way out.
class Iconv {
public:
    explicit Iconv(const std::string& encoding) : handle_(iconv_open("UTF-8", encoding.c_str())) {}
    Iconv(const Iconv&) = delete;
    Iconv& operator=(const Iconv&) = delete;
    ~Iconv() {
        if (isKnown())
            iconv_close(handle_);
    }
    bool isKnown() const { return handle_ != reinterpret_cast<iconv_t>(-1); }

    /// What is no character becomes U+FFFD.
    std::string run(std::string_view text) {
        std::string out;
        std::array<char, 4096> chunk;
        char* from = const_cast<char*>(text.data());
        for (std::size_t left = text.size(); left > 0;) {
            limits::check();
            char* to = chunk.data();
            std::size_t room = chunk.size();
            const bool failed = iconv(handle_, &from, &left, &to, &room) == static_cast<std::size_t>(-1);
            const bool isFull = failed && errno == E2BIG;
            out.append(chunk.data(), chunk.size() - room);
            if (failed && !isFull) {
                appendUtf8(out, 0xfffd);
                ++from, --left;
            }
        }
        return out;
    }

private:
    iconv_t handle_;
};

/// What is declared in bytes that read as ASCII cannot be one of the encodings of wider units.
bool isWide(std::string_view encoding) {
    constexpr std::array<std::string_view, 4> names{"utf", "ucs", "iso-10646", "unicode"};
    return std::ranges::any_of(
        names, [&](auto name) { return equalsIgnoringCase(encoding.substr(0, name.size()), name); });
}

/// Encodings that are not known are taken for UTF-8.
std::string fromDeclared(std::string_view text) {
    const std::string_view encoding = declaredEncoding(text);
    if (encoding.empty() || isWide(encoding) || !std::ranges::all_of(encoding, isIdentifier))
        return std::string(text);
    Iconv converter{std::string(encoding)};
    return converter.isKnown() ? converter.run(text) : std::string(text);
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
    // Without a mark the first '<' tells (XML 1.0 appendix F).
    if (bytes.size() >= 2 && (bytes[0] == 0) != (bytes[1] == 0))
        return fromUtf16(bytes, bytes[0] == 0);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    return fromDeclared(text);
}

// ---- Internal entities (XML 1.0 section 4) ------------------------------------------------------
// Illustrator writes its namespaces as entities, and some files keep whole fragments in them. Replacement is
// textual, before the XML is parsed.

namespace {

/// How much text entities may add in all, and how deep they may refer to each other: a "billion
/// laughs" file is an error instead of a full memory.
constexpr std::size_t maxExpansion = 16u << 20;
constexpr int maxEntityDepth = 16;

using Entities = std::unordered_map<std::string_view, std::string_view>;

/// `<!ENTITY name "value">`, the cursor behind `<!ENTITY`. Parameter and external entities are left
/// undefined.
void readEntity(Cursor& cursor, Entities& entities) {
    cursor.skipSpaces();
    const std::string_view name = cursor.identifier();
    cursor.skipSpaces();
    const char quote = cursor.peek();
    if (!name.empty() && (quote == '"' || quote == '\'')) {
        cursor.advance();
        entities.try_emplace(name, cursor.until(quote));
    }
}

/// Reads the internal subset, the cursor behind its `[`.
Entities readSubset(Cursor& cursor) {
    Entities entities;
    while (!cursor.atEnd() && !cursor.consume(']')) {
        limits::check();
        if (cursor.consume("<!--")) {
            const std::size_t end = cursor.rest().find("-->");
            cursor.advance(end == std::string_view::npos ? cursor.rest().size() : end + 3);
        } else if (cursor.consume("<!ENTITY")) {
            readEntity(cursor, entities);
        } else if (cursor.peek() == '"' || cursor.peek() == '\'') {
            const char quote = cursor.peek();
            cursor.advance();
            cursor.until(quote);
        } else {
            cursor.advance();
        }
    }
    return entities;
}

/// The entities of the DOCTYPE, if there is one with an internal subset; `end` is where it ends.
Entities readDoctype(std::string_view text, std::size_t& end) {
    const std::size_t start = text.find("<!DOCTYPE");
    if (start == text.npos)
        return {};
    const std::size_t bracket = text.find_first_of("[>", start);
    if (bracket == text.npos || text[bracket] != '[')
        return {};
    Cursor cursor(text.substr(bracket + 1));
    Entities entities = readSubset(cursor);
    end = text.size() - cursor.rest().size();
    return entities;
}

class Expander {
public:
    Expander(const Entities& entities, std::string_view source, SourceMap& map)
        : entities_(entities), source_(source), map_(map) {}

    std::string run(std::size_t from) {
        out_ = source_.substr(0, from);
        copy(source_.substr(from), 0);
        return std::move(out_);
    }

private:
    /// Where in the source a piece of it begins; inside an entity, where its reference stands.
    std::size_t sourceOffset(std::string_view text) const {
        return static_cast<std::size_t>(text.data() - source_.data());
    }

    void copy(std::string_view text, int depth) {
        Cursor cursor(text);
        while (!cursor.atEnd()) {
            limits::check();
            const std::string_view rest = cursor.rest();
            std::size_t plain = std::min(rest.find_first_of("&<"), rest.size());
            if (rest.substr(plain).starts_with("<!--"))
                plain = std::min(rest.find("-->", plain), rest.size());
            else if (rest.substr(plain).starts_with("<![CDATA["))
                plain = std::min(rest.find("]]>", plain), rest.size());
            else if (plain < rest.size() && rest[plain] == '<')
                ++plain;
            append(rest.substr(0, plain), depth);
            cursor.advance(plain);
            if (cursor.peek() == '&')
                reference(cursor, depth);
        }
    }

    void append(std::string_view text, int depth) {
        if (depth > 0)
            added_ += text.size();
        if (added_ > maxExpansion)
            fail("entities expand to too much text");
        out_ += text;
    }

    /// The cursor stands on '&'. Unknown entities and character references stay as they are.
    void reference(Cursor& cursor, int depth) {
        const std::string_view start = cursor.rest();
        cursor.advance();
        const std::string_view name = cursor.identifier();
        const auto found = entities_.find(name);
        if (found == entities_.end() || !cursor.consume(';')) {
            append(start.substr(0, start.size() - cursor.rest().size()), depth);
            return;
        }
        if (depth == 0) {
            referenceAt_ = sourceOffset(start);
            map_.addPiece(out_.size(), referenceAt_, true);
        }
        if (depth >= maxEntityDepth)
            fail("entities are nested too deep");
        added_ += name.size();  // so that empty ones are not free
        copy(found->second, depth + 1);
        if (depth == 0)
            map_.addPiece(out_.size(), sourceOffset(cursor.rest()), false);
    }

    [[noreturn]] void fail(const char* what) const { throw ParseError(map_.atSource(referenceAt_), what); }

    const Entities& entities_;
    std::string_view source_;
    SourceMap& map_;
    std::string out_;
    std::size_t added_ = 0, referenceAt_ = 0;
};

}  // namespace

std::string expandEntities(std::string text, SourceMap& map) {
    std::size_t end = 0;
    const Entities entities = readDoctype(text, end);
    return entities.empty() ? std::move(text) : Expander(entities, text, map).run(end);
}

}  // namespace vtm::svg

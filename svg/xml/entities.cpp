// Internal entities (XML 1.0 section 4): Illustrator writes its namespaces as entities, and some
// files keep whole fragments in them. Replacement is textual, before the XML is parsed.

#include <unordered_map>

#include <vtm/limits/limits.hpp>
#include "svg/css/cursor.hpp"
#include "svg/xml/decode.hpp"

namespace vtm::svg {
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

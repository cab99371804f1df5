#include "svg/css/css.hpp"

#include <algorithm>
#include <optional>

#include <vtm/limits/limits.hpp>
#include "svg/css/conditions.hpp"
#include "svg/css/cursor.hpp"

namespace vtm::svg {

namespace {

std::string_view take(Cursor& cursor, std::string_view ends) {
    const std::string_view part = cursor.rest().substr(0, extentOf(cursor.rest(), ends));
    cursor.advance(part.size());
    return part;
}

/// `value ! important`
bool splitImportant(std::string_view& value) {
    const std::size_t mark = value.rfind('!');
    if (mark == value.npos || !equalsIgnoringCase(trim(value.substr(mark + 1)), "important"))
        return false;
    value = trim(value.substr(0, mark));
    return true;
}

void blank(std::string& text, std::string_view open, std::string_view close) {
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
        const std::size_t end = std::min(text.find(close, at + open.size()), text.size());
        const std::size_t stop = std::min(end + close.size(), text.size());
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                  text.begin() + static_cast<std::ptrdiff_t>(stop), ' ');
    }
}

}  // namespace

std::vector<RawDeclaration> parseDeclarations(std::string_view text) {
    std::vector<RawDeclaration> declarations;
    for (Cursor cursor(text); !cursor.atEnd(); cursor.consume(';')) {
        limits::check();
        const std::string_view declaration = take(cursor, ";");
        const std::size_t colon = declaration.find(':');
        if (colon == declaration.npos)
            continue;
        std::string_view value = trim(declaration.substr(colon + 1));
        const bool important = splitImportant(value);
        declarations.push_back({trim(declaration.substr(0, colon)), value, important});
    }
    return declarations;
}

namespace {

constexpr int maxBlocks = 16;  ///< of at-rules in each other

/// What stands between the quotes, if there are any.
std::string_view unquoted(std::string_view text) {
    const bool isQuoted = text.size() >= 2 && (text.front() == '"' || text.front() == '\'');
    return isQuoted && text.back() == text.front() ? text.substr(1, text.size() - 2) : text;
}

/// `url(x)` or a string.
std::string_view readHref(Cursor& cursor) {
    std::string_view href;
    if (cursor.consume("url(")) {
        href = trim(take(cursor, ")"));
        cursor.consume(')');
    } else {
        href = take(cursor, " \t\n\r\f");
    }
    cursor.skipSpaces();
    return unquoted(href);
}

/// In brackets, the cursor behind the opening one.
std::string_view takeBracketed(Cursor& cursor) {
    const std::string_view inner = take(cursor, ")");
    cursor.consume(')');
    cursor.skipSpaces();
    return inner;
}

class SheetParser {
public:
    explicit SheetParser(Layers& layers) : layers_(layers) {}

    StyleSheet parse(std::string_view text, std::size_t layer) {
        readRules(text, 0, layer);
        return std::move(sheet_);
    }

private:
    void readRules(std::string_view text, int depth, std::size_t layer) {
        Cursor cursor(text);
        for (cursor.skipSpaces(); !cursor.atEnd(); cursor.skipSpaces()) {
            limits::check();
            if (cursor.peek() == '@') {
                readAtRule(cursor, depth, layer);
                continue;
            }
            const std::string_view selectors = take(cursor, "{");
            cursor.consume('{');
            const std::string_view body = take(cursor, "}");
            cursor.consume('}');
            if (auto parsed = parseSelectors(selectors, prefixes_))
                sheet_.rules.push_back({std::move(*parsed), parseDeclarations(body), layer});
            else
                sheet_.ignored.push_back(trim(selectors));
        }
    }

    void readAtRule(Cursor& cursor, int depth, std::size_t layer) {
        const std::string_view start = cursor.rest();
        cursor.advance();
        const std::string_view name = cursor.identifier();
        const auto is = [&](std::string_view other) { return equalsIgnoringCase(name, other); };
        const std::string_view prelude = trim(take(cursor, ";{"));
        const std::string_view head = trim(start.substr(0, start.size() - cursor.rest().size()));
        if (!cursor.consume('{')) {
            cursor.consume(';');
            return readStatement(name, prelude, head, depth, layer);
        }
        const std::string_view body = take(cursor, "}");
        cursor.consume('}');
        if (is("font-face"))
            sheet_.fontFaces.push_back(parseDeclarations(body));
        else if (!is("media") && !is("supports") && !is("layer"))
            sheet_.ignored.push_back(head);
        else if (depth < maxBlocks && (is("layer") || (is("media") && mediaHolds(prelude)) ||
                                       (is("supports") && supportsHolds(prelude))))
            readRules(body, depth + 1, is("layer") ? layerOf(prelude, layer) : layer);
    }

    std::size_t layerOf(std::string_view name, std::size_t parent) {
        return name.empty() ? layers_.add(parent) : layers_.find(parent, name);
    }

    /// An at-rule without a block.
    void readStatement(std::string_view name, std::string_view prelude, std::string_view head, int depth,
                       std::size_t layer) {
        const auto is = [&](std::string_view other) { return equalsIgnoringCase(name, other); };
        // Rules before it make it void (CSS Cascade 4 section 2).
        if (is("import") && depth == 0 && sheet_.rules.empty())
            return readImport(prelude, layer);
        if (is("namespace"))
            return readNamespace(prelude);
        if (is("layer")) {
            for (Cursor cursor(prelude); !cursor.atEnd();)
                layers_.find(layer, trim(cursor.until(',')));
            return;
        }
        if (!is("charset"))
            sheet_.ignored.push_back(head);
    }

    /// `href layer(name) supports(condition) media`
    void readImport(std::string_view text, std::size_t layer) {
        Cursor cursor(text);
        Import import{readHref(cursor), {}, layer};
        if (cursor.consume("layer("))
            import.layer = layerOf(trim(takeBracketed(cursor)), layer);
        else if (equalsIgnoringCase(cursor.rest(), "layer") || cursor.consume("layer "))
            import.layer = layers_.add(layer);
        if (equalsIgnoringCase(cursor.rest(), "layer"))
            cursor = Cursor({});
        cursor.skipSpaces();
        const bool holds = !cursor.consume("supports(") || importSupports(takeBracketed(cursor));
        import.media = trim(cursor.rest());
        if (holds && !import.href.empty())
            sheet_.imports.push_back(import);
    }

    /// Here a declaration may stand without brackets of its own.
    static bool importSupports(std::string_view condition) {
        return supportsHolds("(" + std::string(condition) + ")");
    }

    /// `prefix url(uri)`
    void readNamespace(std::string_view text) {
        Cursor cursor(text);
        std::string_view prefix;
        if (!equalsIgnoringCase(text.substr(0, 4), "url(") && isIdentifier(cursor.peek()))
            prefix = cursor.identifier();
        cursor.skipSpaces();
        prefixes_[prefix] = readHref(cursor);
    }

    Layers& layers_;
    NamespacePrefixes prefixes_;
    StyleSheet sheet_;
};

}  // namespace

StyleSheet parseStyleSheet(std::string_view text, Layers& layers, std::size_t layer) {
    return SheetParser(layers).parse(text, layer);
}

std::string withoutComments(std::string_view text) {
    std::string result(text);
    blank(result, "/*", "*/");
    blank(result, "<!--", "");
    blank(result, "-->", "");
    return result;
}

}  // namespace vtm::svg

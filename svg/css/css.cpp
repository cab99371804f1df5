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

/// `url(x)` or a string, and a list of media.
std::optional<Import> readImport(std::string_view text) {
    Cursor cursor(trim(text));
    std::string_view href;
    if (cursor.consume("url("))
        href = trim(cursor.until(')'));
    else
        href = cursor.rest().substr(0, extentOf(cursor.rest(), " \t\n\r\f")), cursor.advance(href.size());
    if (href.size() >= 2 && (href.front() == '"' || href.front() == '\'') && href.back() == href.front())
        href = href.substr(1, href.size() - 2);
    return href.empty() ? std::nullopt : std::optional(Import{href, trim(cursor.rest())});
}

void readRules(std::string_view text, int depth, StyleSheet& sheet);

/// Behind `@`.
void readAtRule(Cursor& cursor, int depth, StyleSheet& sheet) {
    const std::string_view name = cursor.identifier();
    const auto is = [&](std::string_view other) { return equalsIgnoringCase(name, other); };
    const std::string_view prelude = take(cursor, ";{");
    if (!cursor.consume('{')) {
        cursor.consume(';');
        // Rules before it make it void (CSS Cascade 4 section 2).
        if (is("import") && depth == 0 && sheet.rules.empty())
            if (const auto import = readImport(prelude))
                sheet.imports.push_back(*import);
        return;
    }
    const std::string_view body = take(cursor, "}");
    cursor.consume('}');
    if (is("font-face"))
        sheet.fontFaces.push_back(parseDeclarations(body));
    else if (depth < maxBlocks && ((is("media") && mediaHolds(prelude)) ||
                                   (is("supports") && supportsHolds(prelude)) || is("layer")))
        readRules(body, depth + 1, sheet);
}

void readRules(std::string_view text, int depth, StyleSheet& sheet) {
    Cursor cursor(text);
    for (cursor.skipSpaces(); !cursor.atEnd(); cursor.skipSpaces()) {
        limits::check();
        if (cursor.consume('@')) {
            readAtRule(cursor, depth, sheet);
            continue;
        }
        const std::string_view selectors = take(cursor, "{");
        cursor.consume('{');
        const std::string_view body = take(cursor, "}");
        cursor.consume('}');
        if (auto parsed = parseSelectors(selectors))
            sheet.rules.push_back({std::move(*parsed), parseDeclarations(body)});
    }
}

}  // namespace

StyleSheet parseStyleSheet(std::string_view text) {
    StyleSheet sheet;
    readRules(text, 0, sheet);
    return sheet;
}

std::string withoutComments(std::string_view text) {
    std::string result(text);
    blank(result, "/*", "*/");
    blank(result, "<!--", "");
    blank(result, "-->", "");
    return result;
}

}  // namespace vtm::svg

#include "svg/css/css.hpp"

#include <algorithm>

#include <vtm/limits/limits.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

/// Length of the text up to one of `ends` that stands outside quotes, brackets and escapes.
std::size_t extent(std::string_view text, std::string_view ends) {
    int depth = 0;
    char quote = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\\')
            ++i;
        else if (quote)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (depth == 0 && ends.find(c) != ends.npos)
            return i;
        else if (c == '(' || c == '[' || c == '{')
            ++depth;
        else if ((c == ')' || c == ']' || c == '}') && depth > 0)
            --depth;
    }
    return text.size();
}

std::string_view take(Cursor& cursor, std::string_view ends) {
    const std::string_view part = cursor.rest().substr(0, extent(cursor.rest(), ends));
    cursor.advance(part.size());
    return part;
}

/// Behind `@`: up to a semicolon or over a block.
void skipAtRule(Cursor& cursor) {
    take(cursor, ";{");
    if (cursor.consume('{')) {
        take(cursor, "}");
        cursor.consume('}');
    } else {
        cursor.consume(';');
    }
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

StyleSheet parseStyleSheet(std::string_view text) {
    StyleSheet sheet;
    Cursor cursor(text);
    for (cursor.skipSpaces(); !cursor.atEnd(); cursor.skipSpaces()) {
        limits::check();
        if (cursor.consume("@font-face")) {
            cursor.skipSpaces();
            cursor.consume('{');
            sheet.fontFaces.push_back(parseDeclarations(take(cursor, "}")));
            cursor.consume('}');
            continue;
        }
        if (cursor.consume('@')) {
            skipAtRule(cursor);
            continue;
        }
        const std::string_view selectors = take(cursor, "{");
        cursor.consume('{');
        const std::string_view body = take(cursor, "}");
        cursor.consume('}');
        if (auto parsed = parseSelectors(selectors))
            sheet.rules.push_back({std::move(*parsed), parseDeclarations(body)});
    }
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

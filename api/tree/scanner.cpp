#include "api/tree/scanner.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vtm {

namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isWordPart(char c) { return isLetter(c) || svg::isDigit(c) || c == '-'; }

/// Lines and columns count from 1, columns in characters of UTF-8.
limits::Place placeOf(std::string_view before) {
    const auto isFirstByte = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    const std::size_t line = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
    return {static_cast<std::uint32_t>(1 + std::ranges::count(before, '\n')),
            static_cast<std::uint32_t>(1 + std::ranges::count_if(before.substr(line), isFirstByte))};
}

/// A token, for messages, which hold no bytes but printable ASCII.
std::string shown(std::string_view token) {
    constexpr std::size_t longest = 40;
    if (token.empty())
        return "the end of the file";
    if (token[0] < 0x20 || token[0] == 0x7f)
        return fmt::format("the byte 0x{:02x}", static_cast<unsigned char>(token[0]));
    return fmt::format("'{}'{}", token.substr(0, longest), token.size() > longest ? "..." : "");
}

}  // namespace

std::string_view skipBlank(std::string_view text) {
    constexpr std::string_view mark = "\xef\xbb\xbf", blanks = " \t\r\n\f,";
    if (text.starts_with(mark))
        text.remove_prefix(mark.size());
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
        if (!text.starts_with("//"))
            return text;
        text.remove_prefix(std::min(text.find('\n'), text.size()));
    }
}

std::string_view leadingWord(std::string_view text) {
    if (text.empty() || !isLetter(text[0]))
        return {};
    return text.substr(0, std::size_t(std::ranges::find_if_not(text, isWordPart) - text.begin()));
}

std::string_view Scanner::rest() { return rest_ = skipBlank(rest_); }

std::string_view Scanner::peek() {
    const std::string_view word = leadingWord(rest());
    return word.empty() ? rest_.substr(0, 1) : word;
}

std::string_view Scanner::next() {
    const std::string_view token = peek();
    advance(token.size());
    return token;
}

bool Scanner::accept(std::string_view token) {
    const bool found = peek() == token;
    if (found)
        advance(token.size());
    return found;
}

void Scanner::expect(std::string_view token) {
    if (!accept(token))
        failExpecting(fmt::format("'{}'", token));
}

std::string_view Scanner::word(std::string_view what) {
    if (leadingWord(rest()).empty())
        failExpecting(what);
    return next();
}

double Scanner::number(std::string_view what) {
    svg::Cursor cursor(rest());
    const auto value = cursor.number();
    if (!value)
        failExpecting(what);
    if (!(std::abs(*value) < svg::maxNumber))
        fail(rest_, "the number is beyond 1e30");
    rest_ = cursor.rest();
    return *value;
}

std::string_view Scanner::quoted(std::string_view what) {
    if (peek() != "\"")
        failExpecting(what);
    const std::string_view text = rest_.substr(1);
    std::size_t end = 0;
    while (end < text.size() && text[end] != '"')
        end += text[end] == '\\' ? 2 : 1;
    if (end >= text.size())
        fail(rest_, "the string is not closed");
    rest_ = text.substr(end + 1);
    return text.substr(0, end);
}

std::string Scanner::string(std::string_view what) {
    const std::string_view raw = quoted(what);
    std::string text;
    text.reserve(raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (raw[i] == '\\' && raw[++i] != '"' && raw[i] != '\\')
            fail(raw.substr(i - 1), R"(after \ comes " or \)");
        text += raw[i];
    }
    return text;
}

void Scanner::fail(std::string_view at, const std::string& cause) const {
    const std::size_t offset = at.data() ? std::size_t(at.data() - text_.data()) : text_.size();
    throw TreeError(file_, placeOf(text_.substr(0, offset)), cause);
}

void Scanner::failExpecting(std::string_view what) {
    const std::string found = shown(peek());
    fail(rest_, fmt::format("expected {}, found {}", what, found));
}

}  // namespace vtm

#include "svg/css/cursor.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace vtm::svg {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Whether an unsigned number begins here; std::from_chars alone would take "inf" and "nan" too.
bool startsNumber(std::string_view text) {
    if (text.starts_with('.'))
        text.remove_prefix(1);
    return !text.empty() && isDigit(text.front());
}

/// A number without an exponent, and its length.
struct Decimal {
    double value;
    std::size_t size;
};

/// Most numbers of files: of few enough digits that all of them and the power of ten are doubles, so that
/// dividing rounds once and to nearest, as std::from_chars does. Nothing for others.
std::optional<Decimal> shortDecimal(std::string_view text) {
    constexpr std::size_t mostDigits = 15;  // 10^15 < 2^53
    static constexpr double powers[mostDigits + 1]{1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                   1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    std::uint64_t digits = 0;
    std::size_t i = 0, count = 0, fraction = 0;
    for (; i < text.size() && isDigit(text[i]) && count <= mostDigits; ++i, ++count)
        digits = 10 * digits + std::uint64_t(text[i] - '0');
    if (i + 1 < text.size() && text[i] == '.' && isDigit(text[i + 1])) {
        const std::size_t first = ++i;
        for (; i < text.size() && isDigit(text[i]) && count <= mostDigits; ++i, ++count)
            digits = 10 * digits + std::uint64_t(text[i] - '0');
        fraction = i - first;
    }
    const bool goesOn =
        i < text.size() && (isDigit(text[i]) || lower(text[i]) == 'e' || (text[i] == '.' && fraction == 0));
    if (count > mostDigits || goesOn)
        return std::nullopt;
    return Decimal{double(digits) / powers[fraction], i};
}

}  // namespace

bool isIdentifier(char c) {
    return isDigit(c) || (lower(c) >= 'a' && lower(c) <= 'z') || c == '-' || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

int hexDigit(char c) {
    if (isDigit(c))
        return c - '0';
    return lower(c) >= 'a' && lower(c) <= 'f' ? lower(c) - 'a' + 10 : -1;
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return text;
}

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

void Cursor::skipSpaces() {
    while (!rest_.empty() && isSpace(rest_.front()))
        rest_.remove_prefix(1);
}

void Cursor::skipCommaSpaces() {
    skipSpaces();
    if (consume(','))
        skipSpaces();
}

bool Cursor::consume(char c) {
    if (rest_.empty() || rest_.front() != c)
        return false;
    rest_.remove_prefix(1);
    return true;
}

bool Cursor::consume(std::string_view word) {
    if (!equalsIgnoringCase(rest_.substr(0, word.size()), word))
        return false;
    rest_.remove_prefix(word.size());
    return true;
}

std::optional<double> Cursor::number() {
    std::string_view text = rest_;
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+'))
        text.remove_prefix(1);
    if (!startsNumber(text))
        return std::nullopt;
    if (const std::optional<Decimal> decimal = shortDecimal(text)) {
        rest_ = text.substr(decimal->size);
        return negative ? -decimal->value : decimal->value;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // Out of range leaves the value alone: a huge exponent is huge, a tiny one nothing.
    if (error == std::errc::result_out_of_range) {
        const std::string_view token(text.data(), static_cast<std::size_t>(end - text.data()));
        value = token.find("e-") == token.npos && token.find("E-") == token.npos ? maxNumber : 0;
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    value = std::min(value, maxNumber);
    return negative ? -value : value;
}

std::string_view Cursor::identifier() {
    std::size_t size = 0;
    while (size < rest_.size() && isIdentifier(rest_[size]))
        ++size;
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return word;
}

std::string_view Cursor::word() {
    std::size_t size = 0;
    while (size < rest_.size() && !isSpace(rest_[size]) && rest_[size] != '/' && rest_[size] != ',')
        ++size;
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return word;
}

std::string_view Cursor::nextInList() {
    skipSpaces();
    const auto end = std::find_if(rest_.begin(), rest_.end(), isSpace);
    const std::string_view found = rest_.substr(0, std::size_t(end - rest_.begin()));
    advance(found.size());
    return found;
}

std::string_view Cursor::unit() {
    std::size_t size = 0;
    while (size < rest_.size() && lower(rest_[size]) >= 'a' && lower(rest_[size]) <= 'z')
        ++size;
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return word;
}

std::string_view Cursor::until(char end) {
    const std::size_t size = std::min(rest_.find(end), rest_.size());
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(std::min(size + 1, rest_.size()));
    return part;
}

std::size_t extentOf(std::string_view text, std::string_view ends) {
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

}  // namespace vtm::svg

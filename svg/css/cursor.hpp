/// \file
/// A reading position in a short text: what the micro-syntaxes (numbers, lengths, colours,
/// transforms, path data, CSS) are read with.
#pragma once

#include <optional>
#include <string_view>

namespace vtm::svg {

/// Largest magnitude that a number read from a file keeps; beyond it is clamped. Far above any
/// drawable coordinate, and products of a few such numbers still fit into a double.
inline constexpr double maxNumber = 1e30;

inline bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
inline bool isDigit(char c) { return c >= '0' && c <= '9'; }
/// Letters, digits, '-', '_' and everything beyond ASCII.
bool isIdentifier(char c);
/// 0 to 15, -1 for what is no hexadecimal digit.
int hexDigit(char c);
std::string_view trim(std::string_view text);
/// ASCII letters only.
bool equalsIgnoringCase(std::string_view a, std::string_view b);

/// Length of the text up to one of `ends` that stands outside quotes, brackets and escapes.
std::size_t extentOf(std::string_view text, std::string_view ends);

class Cursor {
public:
    explicit Cursor(std::string_view text) : rest_(text) {}

    bool atEnd() const { return rest_.empty(); }
    char peek() const { return rest_.empty() ? '\0' : rest_.front(); }
    std::string_view rest() const { return rest_; }
    void advance(std::size_t count = 1) { rest_.remove_prefix(count); }

    void skipSpaces();
    /// Spaces with at most one comma among them.
    void skipCommaSpaces();
    /// Steps over `c` if it comes next.
    bool consume(char c);
    /// Steps over `word` if it comes next, ASCII case ignored.
    bool consume(std::string_view word);
    /// `[+-]? (digits | digits? . digits) exponent?`; stays where it is if there is none.
    std::optional<double> number();
    /// Possibly empty.
    std::string_view identifier();
    /// Up to a space, '/' or ','; possibly empty.
    std::string_view word();
    /// Past spaces, up to the next one; empty where nothing comes.
    std::string_view nextInList();
    /// Letters, possibly none: the unit behind a number, which a minus sign would end.
    std::string_view unit();
    /// Up to `end`, which is stepped over; up to the text's end where it does not come.
    std::string_view until(char end);

private:
    std::string_view rest_;
};

}  // namespace vtm::svg

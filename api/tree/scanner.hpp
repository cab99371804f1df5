/// \file
/// The words, numbers and strings of a .vtmtree file.
#pragma once

#include <string>
#include <string_view>

#include <vtm/vtmtree.hpp>
#include "svg/notation.hpp"

namespace vtm {

/// Steps over spaces, commas, a byte order mark and comments. Returns what follows.
std::string_view skipBlank(std::string_view text);

/// A letter or underscore, then letters, digits, underscores and hyphens, all ASCII. May be empty.
std::string_view leadingWord(std::string_view text);

/// A reading position. Blanks before a token are skipped by the function that reads the token.
class Scanner {
public:
    Scanner(std::string_view text, std::string file) : text_(text), rest_(text), file_(std::move(file)) {}

    /// The text from the next token on.
    std::string_view rest();
    bool atEnd() { return rest().empty(); }
    /// The next word, or the next character; empty at the end.
    std::string_view peek();
    std::string_view next();
    bool accept(std::string_view token);
    void expect(std::string_view token);
    void advance(std::size_t bytes) { rest_.remove_prefix(bytes); }

    std::string_view word(std::string_view what);
    double number(std::string_view what);
    /// What stands between quotes, escapes and all.
    std::string_view quoted(std::string_view what);
    /// The same with \" and \\ resolved.
    std::string string(std::string_view what);

    /// Throws TreeError. `at` begins at the offending place.
    [[noreturn]] void fail(std::string_view at, const std::string& cause) const;
    /// At the next token, which is named as what was found.
    [[noreturn]] void failExpecting(std::string_view what);

private:
    const std::string_view text_;
    std::string_view rest_;
    const std::string file_;
};

}  // namespace vtm

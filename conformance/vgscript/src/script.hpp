/// \file
/// A script's text as statements of words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vtm::vgscript {

/// One word, or a list in brackets: `[1 2 3]`, `f[1 2 3]`.
struct Word {
    std::string text;         ///< of a list, the letter before it
    std::vector<Word> items;  ///< of a list
    bool isList = false, isQuoted = false;
};

/// One line: `[TARGET =] WORDS... [== VALUE [within NUMBER]]`.
struct Statement {
    int line = 0;
    std::string target;          ///< empty: none
    std::vector<Word> words;     ///< at least one
    std::vector<Word> expected;  ///< one word, or none
    bool isEqual = true;         ///< `==`, not `!=`
    double within = 0;
};

/// Throws ScriptError. A `#` that begins a word begins a comment; a line that ends in a backslash goes on.
std::vector<Statement> parse(std::string_view text, const std::string& name);

/// Throws ScriptError for a place in a script.
[[noreturn]] void fail(const std::string& name, int line, const std::string& what);

}  // namespace vtm::vgscript

#include "backend_gl/texture/prefixed.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace vtm::gl {

namespace {

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool isBlank(char c) { return c == ' ' || c == '\t'; }

std::string withoutComments(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i, 2) == "//")
            i = std::min(text.find('\n', i), text.size());
        if (i < text.size())
            result += text[i];
    }
    return result;
}

/// Words, single other characters, and runs of blanks.
std::vector<std::string_view> tokens(std::string_view text) {
    std::vector<std::string_view> result;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        for (const auto is : {isWord, isBlank})
            while (is(text[i]) && end < text.size() && is(text[end]))
                ++end;
        result.push_back(text.substr(i, end - i));
        i = end;
    }
    return result;
}

/// What is declared outside all braces: words before `(`, behind `struct`, before `=`; and behind `#define`.
std::set<std::string_view> declared(const std::vector<std::string_view>& all) {
    std::set<std::string_view> names;
    std::string_view last, beforeLast;  // words, blanks left out
    int depth = 0;
    for (const std::string_view token : all) {
        if (isBlank(token[0]))
            continue;
        if (beforeLast == "define" || (depth == 0 && beforeLast == "struct") ||
            (depth == 0 && (token == "(" || token == "=") && isWord(last[0]) && isWord(beforeLast[0])))
            names.insert(last);
        depth += token == "{" || token == "(" ? 1 : token == "}" || token == ")" ? -1 : 0;
        beforeLast = last.empty() ? token : last;
        last = token;
    }
    return names;
}

std::string prefixOf(std::string_view name) {
    for (const std::string_view taken : {"vtm_", "Vtm", "VTM_"})
        if (name.starts_with(taken))
            return "";
    const bool isMacro = std::ranges::none_of(name, [](unsigned char c) { return std::islower(c); });
    return isMacro ? "VTM_" : "vtm_";
}

std::string withoutIdleLines(const std::string& text, const std::vector<std::string_view>& all) {
    std::map<std::string_view, int> uses;
    for (const std::string_view token : all)
        ++uses[token];
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);) {
        line.erase(line.find_last_not_of(" \t") + 1);
        const std::vector<std::string_view> words = tokens(line);
        const bool isIdle = words.size() > 4 && words[0] == "const" && uses[words[4]] == 1;
        if (!line.empty() && !isIdle)
            result += line + '\n';
    }
    return result;
}

}  // namespace

std::string prefixed(std::string_view glsl) {
    const std::string plain = withoutComments(glsl);
    const std::string text = withoutIdleLines(plain, tokens(plain));
    const std::vector<std::string_view> all = tokens(text);
    const std::set<std::string_view> names = declared(all);
    std::string result;
    std::string_view before;
    for (const std::string_view token : all) {
        if (before != "." && names.contains(token))  // behind a point stands a member
            result += prefixOf(token);
        result += token;
        before = token;
    }
    return result;
}

}  // namespace vtm::gl

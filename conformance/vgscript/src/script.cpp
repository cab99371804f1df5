#include "conformance/vgscript/src/script.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "conformance/vgscript/vgscript.hpp"

namespace vtm::vgscript {

namespace {

struct Line {
    int number;  // where it begins
    std::string text;
};

std::vector<Line> lines(std::string_view text) {
    std::vector<Line> lines;
    bool goesOn = false;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        std::string line(text.substr(0, end));
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        const bool continues = !line.empty() && line.back() == '\\';
        if (continues)
            line.pop_back();
        if (goesOn)
            lines.back().text += line;
        else
            lines.push_back({number, std::move(line)});
        goesOn = continues;
    }
    return lines;
}

/// The words of one line.
class Words {
public:
    Words(const Line& line, const std::string& name) : line_(line), name_(name) {}

    std::vector<Word> read() {
        std::vector<Word> words = sequence();
        if (next_ < line_.text.size())
            fail(name_, line_.number, "']' without '['");
        return words;
    }

private:
    static constexpr std::string_view spaces = " \t\r";

    std::vector<Word> sequence() {
        std::vector<Word> words;
        while (skipSpaces() && line_.text[next_] != ']')
            words.push_back(word());
        return words;
    }
    /// False at the end and at a comment.
    bool skipSpaces() {
        next_ = std::min(line_.text.find_first_not_of(spaces, next_), line_.text.size());
        if (next_ < line_.text.size() && line_.text[next_] == '#')
            next_ = line_.text.size();
        return next_ < line_.text.size();
    }
    Word word() {
        Word word;
        if (line_.text[next_] == '"') {
            const std::size_t end = line_.text.find('"', next_ + 1);
            if (end == std::string::npos)
                fail(name_, line_.number, "a quotation without end");
            word.text = line_.text.substr(next_ + 1, end - next_ - 1);
            word.isQuoted = true;
            next_ = end + 1;
            return word;
        }
        const std::size_t end = std::min(line_.text.find_first_of(" \t\r[]\"", next_), line_.text.size());
        word.text = line_.text.substr(next_, end - next_);
        next_ = end;
        if (next_ < line_.text.size() && line_.text[next_] == '[') {
            ++next_;
            word.isList = true;
            word.items = sequence();
            if (next_ >= line_.text.size())
                fail(name_, line_.number, "'[' without ']'");
            ++next_;
        }
        return word;
    }

    const Line& line_;
    const std::string& name_;
    std::size_t next_ = 0;
};

bool isOperator(const Word& word) {
    return !word.isQuoted && !word.isList && (word.text == "==" || word.text == "!=");
}

Statement statement(std::vector<Word> words, const Line& line, const std::string& name) {
    Statement result;
    result.line = line.number;
    if (words.size() > 1 && !words[1].isQuoted && words[1].text == "=") {
        result.target = words[0].text;
        words.erase(words.begin(), words.begin() + 2);
    }
    const auto comparison = std::find_if(words.begin(), words.end(), isOperator);
    if (comparison != words.end()) {
        const std::vector<Word> right(comparison + 1, words.end());
        const bool hasTolerance = right.size() == 3 && right[1].text == "within";
        if (right.size() != 1 && !hasTolerance)
            fail(name, line.number, "after == or != comes a value, then perhaps 'within' and a number");
        result.isEqual = comparison->text == "==";
        result.expected = {right[0]};
        try {
            result.within = hasTolerance ? std::stod(right[2].text) : 0;
        } catch (const std::exception&) {
            fail(name, line.number, fmt::format("'{}' is no number", right[2].text));
        }
        words.erase(comparison, words.end());
    }
    if (words.empty())
        fail(name, line.number, "nothing to do");
    result.words = std::move(words);
    return result;
}

}  // namespace

void fail(const std::string& name, int line, const std::string& what) {
    throw ScriptError(fmt::format("{}:{}: {}", name, line, what));
}

std::vector<Statement> parse(std::string_view text, const std::string& name) {
    std::vector<Statement> statements;
    for (const Line& line : lines(text)) {
        std::vector<Word> words = Words(line, name).read();
        if (!words.empty())
            statements.push_back(statement(std::move(words), line, name));
    }
    return statements;
}

}  // namespace vtm::vgscript

#include "svg/text/content.hpp"

#include "text/utf8.hpp"

namespace vtm::svg {
namespace {

/// Tabs and ends of lines are spaces: SVG text has one line.
char32_t withoutBreaks(char32_t code) {
    return code == '\t' || code == '\n' || code == '\r' || code == '\f' ? U' ' : code;
}

bool collapses(const RawCharacter& character) {
    return character.code == ' ' && character.whiteSpace == WhiteSpace::Collapse;
}

}  // namespace

void appendCharacters(std::string_view utf8, int element, WhiteSpace whiteSpace, bool rendered,
                      std::vector<RawCharacter>& out) {
    while (!utf8.empty()) {
        const bool crLf = utf8.starts_with("\r\n");
        out.push_back({withoutBreaks(text::readCharacter(utf8)), element, whiteSpace, rendered});
        if (crLf)
            utf8.remove_prefix(1);
    }
}

std::vector<bool> keptCharacters(const std::vector<RawCharacter>& raw) {
    std::vector<bool> kept(raw.size(), true);
    std::size_t last = raw.size();  // of a space that may be the text's last
    bool afterSpace = true;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const bool space = collapses(raw[i]);
        kept[i] = raw[i].rendered && !(space && afterSpace);
        if (kept[i])
            last = space ? i : raw.size();
        afterSpace = raw[i].rendered && raw[i].code == ' ';
    }
    if (last < raw.size())
        kept[last] = false;
    return kept;
}

}  // namespace vtm::svg

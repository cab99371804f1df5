#include "svg/text/content.hpp"

namespace vtm::svg {
namespace {

constexpr char32_t replacement = 0xfffd;

/// Reads one character and steps over it.
char32_t readCharacter(std::string_view& utf8) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(utf8[i]); };
    const unsigned char lead = byte(0);
    const std::size_t size = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    char32_t code = size == 1 ? lead : lead & (0xff >> (size + 1));
    bool valid = lead < 0x80 || (lead >= 0xc2 && lead <= 0xf4);
    for (std::size_t i = 1; valid && i < size; ++i) {
        valid = i < utf8.size() && (byte(i) & 0xc0) == 0x80;
        code = valid ? code << 6 | (byte(i) & 0x3f) : code;
    }
    utf8.remove_prefix(valid ? size : 1);
    return valid && code <= 0x10ffff ? code : replacement;
}

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
        out.push_back({withoutBreaks(readCharacter(utf8)), element, whiteSpace, rendered});
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

#include "text/shape/runs.hpp"

#include <fribidi.h>
#include <hb.h>

#include <algorithm>
#include <map>
#include <utility>

#include "text/character_ranges.hpp"

namespace vtm::text {
namespace {

/// How characters stand in vertical lines. Source: UAX 50, VerticalOrientation.txt of Unicode 15.
constexpr CharacterRange uprightRanges[]{
    {0x00a7, 0x00a7},   {0x00a9, 0x00a9},   {0x00ae, 0x00ae},   {0x00b1, 0x00b1},   {0x00bc, 0x00be},
    {0x00d7, 0x00d7},   {0x00f7, 0x00f7},   {0x02ea, 0x02eb},   {0x1100, 0x11ff},   {0x1401, 0x167f},
    {0x18b0, 0x18ff},   {0x2016, 0x2016},   {0x2020, 0x2021},   {0x2030, 0x2031},   {0x203b, 0x203c},
    {0x2042, 0x2042},   {0x2047, 0x2049},   {0x2051, 0x2051},   {0x2065, 0x2065},   {0x20dd, 0x20e0},
    {0x20e2, 0x20e4},   {0x2100, 0x2101},   {0x2103, 0x2109},   {0x210f, 0x210f},   {0x2113, 0x2114},
    {0x2116, 0x2117},   {0x211e, 0x2123},   {0x2125, 0x2125},   {0x2127, 0x2127},   {0x2129, 0x2129},
    {0x212e, 0x212e},   {0x2135, 0x213f},   {0x2145, 0x214a},   {0x214c, 0x214d},   {0x214f, 0x2189},
    {0x218c, 0x218f},   {0x221e, 0x221e},   {0x2234, 0x2235},   {0x2300, 0x2307},   {0x230c, 0x231f},
    {0x2324, 0x232b},   {0x237d, 0x239a},   {0x23be, 0x23cd},   {0x23cf, 0x23cf},   {0x23d1, 0x23db},
    {0x23e2, 0x2422},   {0x2424, 0x24ff},   {0x25a0, 0x2619},   {0x2620, 0x2767},   {0x2776, 0x2793},
    {0x2b12, 0x2b2f},   {0x2b50, 0x2b59},   {0x2b97, 0x2b97},   {0x2bb8, 0x2bd1},   {0x2bd3, 0x2beb},
    {0x2bf0, 0x2bff},   {0x2e50, 0x2e51},   {0x2e80, 0xa4cf},   {0xa960, 0xa97f},   {0xac00, 0xd7ff},
    {0xe000, 0xfaff},   {0xfe10, 0xfe1f},   {0xfe30, 0xfe48},   {0xfe50, 0xfe57},   {0xfe59, 0xfe62},
    {0xfe67, 0xfe6f},   {0xff01, 0xff0c},   {0xff0e, 0xff1b},   {0xff1f, 0xff60},   {0xffe0, 0xffe7},
    {0xfff0, 0xfff8},   {0xfffc, 0xfffd},   {0x10980, 0x1099f}, {0x11580, 0x115ff}, {0x11a00, 0x11abf},
    {0x13000, 0x1467f}, {0x16fe0, 0x18d7f}, {0x1aff0, 0x1b2ff}, {0x1cf00, 0x1cfcf}, {0x1d000, 0x1d37f},
    {0x1d800, 0x1daaf}, {0x1f000, 0x1f7ff}, {0x1f900, 0x1faff}, {0x20000, 0x3fffd}, {0xf0000, 0x10fffd}};

/// True for U, Tu and Tr: upright as they are, or with the glyph that the font has for vertical lines.
bool standsUpright(char32_t character) { return contains(uprightRanges, character); }

constexpr char32_t zeroWidthJoiner = 0x200d;

bool isVariationSelector(char32_t c) {
    return (c >= 0xfe00 && c <= 0xfe0f) || (c >= 0xe0100 && c <= 0xe01ef);
}

/// Embedding levels (UAX 9), trailing white space at the line's own level.
std::vector<FriBidiLevel> embeddingLevels(const Line& line) {
    const auto length = static_cast<FriBidiStrIndex>(line.text.size());
    std::vector<FriBidiLevel> levels(line.text.size(), 0);
    const auto* text = reinterpret_cast<const FriBidiChar*>(line.text.data());
    std::vector<FriBidiCharType> types(line.text.size());
    std::vector<FriBidiBracketType> brackets(line.text.size());
    fribidi_get_bidi_types(text, length, types.data());
    fribidi_get_bracket_types(text, length, types.data(), brackets.data());
    FriBidiParType direction = line.rightToLeft ? FRIBIDI_PAR_RTL : FRIBIDI_PAR_LTR;
    // Fails where there is no memory: then nothing is reordered.
    if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), length, &direction,
                                            levels.data()) == 0 ||
        fribidi_reorder_line(FRIBIDI_FLAGS_DEFAULT, types.data(), length, 0, direction, levels.data(),
                             nullptr, nullptr) == 0)
        std::fill(levels.begin(), levels.end(), FriBidiLevel(0));
    return levels;
}

bool isReal(hb_script_t script) {
    return script != HB_SCRIPT_COMMON && script != HB_SCRIPT_INHERITED && script != HB_SCRIPT_UNKNOWN;
}

/// Scripts by character. Those that belong to any script take that of the character before, or else after,
/// that runs in the same direction: a full stop in a Latin line is Latin behind an Arabic word, too.
std::vector<hb_script_t> scriptsOf(const std::u32string& text, const std::vector<FriBidiLevel>& levels) {
    hb_unicode_funcs_t* const unicode = hb_unicode_funcs_get_default();
    std::vector<hb_script_t> scripts;
    hb_script_t last[2]{HB_SCRIPT_COMMON, HB_SCRIPT_COMMON};  // by direction; first the first real one
    for (std::size_t i = text.size(); i-- > 0;)
        if (const hb_script_t script = hb_unicode_script(unicode, text[i]); isReal(script))
            last[levels[i] % 2] = script;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const hb_script_t script = hb_unicode_script(unicode, text[i]);
        hb_script_t& before = last[levels[i] % 2];
        scripts.push_back(before = isReal(script) ? script : before);
    }
    return scripts;
}

/// Where graphemes begin: marks, joined characters, variation selectors, modifiers and flags go on with them.
std::vector<bool> graphemeStarts(const std::u32string& text) {
    std::vector<bool> starts(text.size(), true);
    const auto isFlagLetter = [](char32_t c) { return c >= 0x1f1e6 && c <= 0x1f1ff; };
    std::size_t flagLetters = 0;  // in a row, before this one
    for (std::size_t i = 1; i < text.size(); ++i) {
        flagLetters = isFlagLetter(text[i - 1]) ? flagLetters + 1 : 0;
        const bool skinTone = text[i] >= 0x1f3fb && text[i] <= 0x1f3ff;
        const bool secondOfFlag = isFlagLetter(text[i]) && flagLetters % 2 == 1;
        starts[i] = !(isMark(text[i]) || skinTone || secondOfFlag || text[i - 1] == zeroWidthJoiner);
    }
    return starts;
}

/// Fonts by character, one for each grapheme.
class FontPicker {
public:
    FontPicker(const Line& line, FontSet& fonts) : line_(line), fonts_(fonts) {}

    std::vector<std::shared_ptr<const Font>> pick(const std::vector<std::size_t>& spans) {
        std::vector<std::shared_ptr<const Font>> picked(line_.text.size());
        const std::vector<bool> starts = graphemeStarts(line_.text);
        for (std::size_t first = 0, end = 0; first < picked.size(); first = end) {
            do
                ++end;
            while (end < picked.size() && !starts[end]);
            const bool ignored = end == first + 1 && isInvisible(line_.text[first]) && first > 0;
            const auto font = ignored ? picked[first - 1] : fontOf(spans[first], first, end);
            std::fill(picked.begin() + static_cast<std::ptrdiff_t>(first),
                      picked.begin() + static_cast<std::ptrdiff_t>(end), font);
        }
        return picked;
    }

private:
    /// Controls and spaces take the font of what is before them, so that they break no run.
    static bool isInvisible(char32_t c) {
        return (c >= 0x200b && c <= 0x200f) || (c >= 0x2028 && c <= 0x202e) || (c >= 0x2060 && c <= 0x206f);
    }

    /// Of a family before the primary font's, too: unicode-range may leave that one a part of the characters.
    std::shared_ptr<const Font> fontOf(std::size_t span, std::size_t first, std::size_t end) {
        const FontQuery& query = line_.spans[span].font;
        if (std::exchange(span_, span) != span)
            known_.clear();
        const std::u32string_view characters = std::u32string_view(line_.text).substr(first, end - first);
        const auto [known, isNew] = known_.try_emplace(characters);
        if (isNew)
            known->second = fonts_.covering(query, characters);
        if (!known->second)
            known->second = fonts_.primary(query);
        return known->second;
    }

    const Line& line_;
    FontSet& fonts_;
    std::size_t span_ = 0;
    std::map<std::u32string_view, std::shared_ptr<const Font>> known_;  ///< of one span's clusters
};

std::vector<std::size_t> spansByCharacter(const Line& line) {
    std::vector<std::size_t> spans;
    for (std::size_t span = 0; span < line.spans.size(); ++span)
        spans.resize(line.spans[span].end, span);
    return spans;
}

/// Upright or sideways by grapheme, as its first character says.
std::vector<bool> uprightCharacters(const Line& line, const std::vector<std::size_t>& spans) {
    std::vector<bool> upright(line.text.size(), false);
    for (std::size_t i = 0; line.vertical && i < line.text.size(); ++i) {
        const TextOrientation orientation = line.spans[spans[i]].orientation;
        upright[i] = orientation == TextOrientation::Upright ||
                     (orientation == TextOrientation::Mixed && standsUpright(line.text[i]));
        if (i > 0 && isMark(line.text[i]))
            upright[i] = upright[i - 1];
    }
    return upright;
}

/// Letters of two sizes share neither pairs nor ligatures, even of one font.
bool shapeAlike(const Span& a, const Span& b) {
    return a.features == b.features && a.language == b.language && a.orientation == b.orientation &&
           a.font.opticalSize == b.font.opticalSize;
}

/// UAX 9 rule L2: from the highest level down to the lowest odd one, runs of at least that level are
/// reversed.
void reorder(std::vector<Run>& runs) {
    int highest = 0;
    for (const Run& run : runs)
        highest = std::max<int>(highest, run.level);
    for (int level = highest; level > 0; --level)
        for (auto first = runs.begin(); first != runs.end();) {
            const auto isBelow = [&](const Run& run) { return run.level < level; };
            first = std::find_if_not(first, runs.end(), isBelow);
            const auto end = std::find_if(first, runs.end(), isBelow);
            std::reverse(first, end);
            first = end;
        }
}

}  // namespace

bool isMark(char32_t character) {
    const hb_unicode_general_category_t category =
        hb_unicode_general_category(hb_unicode_funcs_get_default(), character);
    return category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
           category == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK ||
           category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK || character == zeroWidthJoiner ||
           isVariationSelector(character);
}

std::vector<Run> visualRuns(const Line& line, FontSet& fonts) {
    const std::vector<std::size_t> spans = spansByCharacter(line);
    const std::vector<FriBidiLevel> levels = embeddingLevels(line);
    const std::vector<hb_script_t> scripts = scriptsOf(line.text, levels);
    const std::vector<bool> upright = uprightCharacters(line, spans);
    const auto picked = FontPicker(line, fonts).pick(spans);
    std::vector<Run> runs;
    for (std::size_t i = 0; i < line.text.size(); ++i) {
        const bool goesOn = !runs.empty() && runs.back().level == static_cast<std::uint8_t>(levels[i]) &&
                            runs.back().script == static_cast<std::uint32_t>(scripts[i]) &&
                            runs.back().font == picked[i] && runs.back().upright == upright[i] &&
                            shapeAlike(line.spans[runs.back().span], line.spans[spans[i]]);
        if (!goesOn)
            runs.push_back({i, i, spans[i], picked[i], static_cast<std::uint32_t>(scripts[i]),
                            static_cast<std::uint8_t>(levels[i]), upright[i]});
        runs.back().end = i + 1;
    }
    reorder(runs);
    return runs;
}

}  // namespace vtm::text

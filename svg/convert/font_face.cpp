// `@font-face`: fonts that a document brings along. Source: CSS Fonts 4 section 4.

#include <fmt/format.h>

#include "svg/convert/converter.hpp"
#include "svg/css/font_values.hpp"
#include "svg/css/property_values.hpp"
#include "svg/xml/resource.hpp"

namespace vtm::svg {
namespace {

std::string_view descriptor(const FontFaceRule& rule, std::string_view name) {
    for (auto found = rule.descriptors.rbegin(); found != rule.descriptors.rend(); ++found)
        if (equalsIgnoringCase(found->name, name))
            return found->value;
    return {};
}

/// One value or two, least first; nothing for anything else.
template <class Parse>
std::optional<std::pair<double, double>> range(std::string_view text, Parse parse) {
    Cursor cursor(text);
    std::vector<double> values;
    for (; !cursor.atEnd(); cursor.skipSpaces()) {
        const std::string_view rest = cursor.rest();
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t\n"));
        const auto value = parse(word, Units{});
        if (!value)
            return std::nullopt;
        values.push_back(*value);
        cursor.advance(word.size());
    }
    if (values.empty() || values.size() > 2)
        return std::nullopt;
    return std::pair(std::min(values.front(), values.back()), std::max(values.front(), values.back()));
}

std::optional<char32_t> hexNumber(Cursor& cursor, char filler) {
    char32_t value = 0;
    int digits = 0;
    for (; digits < 6 && (hexDigit(cursor.peek()) >= 0 || (filler && cursor.peek() == '?')); ++digits) {
        const int digit = cursor.peek() == '?' ? (filler == 'f' ? 15 : 0) : hexDigit(cursor.peek());
        value = value * 16 + static_cast<char32_t>(digit);
        cursor.advance();
    }
    return digits > 0 ? std::optional(value) : std::nullopt;
}

/// `U+26, U+0-7F, U+4??`. Empty, all characters, where it is malformed.
std::vector<text::FontFace::Range> unicodeRange(std::string_view text) {
    std::vector<text::FontFace::Range> ranges;
    for (Cursor cursor(text); !cursor.atEnd(); cursor.skipCommaSpaces()) {
        if (!cursor.consume("u+"))
            return {};
        Cursor again = cursor;
        const auto first = hexNumber(cursor, '0');
        auto last = hexNumber(again, 'f');
        if (cursor.consume('-'))
            last = hexNumber(cursor, 0);
        if (!first || !last)
            return {};
        ranges.push_back({*first, *last});
    }
    return ranges;
}

text::FontFace faceOf(const FontFaceRule& rule, std::string family) {
    text::FontFace face;
    face.family = std::move(family);
    if (const auto weight = range(descriptor(rule, "font-weight"), parseFontWeight))
        std::tie(face.minWeight, face.maxWeight) = *weight;
    if (const auto stretch = range(descriptor(rule, "font-stretch"), parseFontStretch))
        std::tie(face.minStretch, face.maxStretch) = *stretch;
    face.slant = parseFontStyle(descriptor(rule, "font-style"), {}).value_or(text::Slant::Normal);
    face.characters = unicodeRange(descriptor(rule, "unicode-range"));
    return face;
}

/// The URLs of `src`, in order. Installed fonts, `local()`, are passed over.
std::vector<std::string_view> urlsIn(std::string_view src) {
    std::vector<std::string_view> urls;
    for (Cursor cursor(src); !cursor.atEnd();) {
        if (const auto url = readUrl(cursor))
            urls.push_back(*url);
        else
            cursor.advance();
    }
    return urls;
}

}  // namespace

void Converter::addFontFaces(text::FontSet& fonts) {
    for (const FontFaceRule& rule : tree_.fontFaces) {
        const std::vector<std::string> families = familiesIn(descriptor(rule, "font-family"));
        const std::vector<std::string_view> urls = urlsIn(descriptor(rule, "src"));
        if (families.empty() || urls.empty())
            continue;
        std::string cause;
        const bool added = std::any_of(urls.begin(), urls.end(), [&](std::string_view url) {
            return addFontFace(fonts, faceOf(rule, families.front()), url, rule.directory, cause);
        });
        if (!added)
            reporter_.warn(
                Kind::Font, *rule.sheet,
                fmt::format("the font of the family \"{}\" cannot be used: {}", families.front(), cause));
    }
}

bool Converter::addFontFace(text::FontSet& fonts, const text::FontFace& face, std::string_view url,
                            const std::string& directory, std::string& cause) {
    try {
        fonts.add(face, readResource(url, directory, options_.resourceRoot));
        return true;
    } catch (const limits::Exceeded&) {
        throw;
    } catch (const Error& error) {
        cause = isDataUrl(url) ? error.what() : fmt::format("\"{}\" {}", url.substr(0, 200), error.what());
        return false;
    }
}

}  // namespace vtm::svg

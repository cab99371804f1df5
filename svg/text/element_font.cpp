#include "svg/text/element_font.hpp"

#include <clocale>
#include <cwctype>

#include "svg/css/font_values.hpp"
#include "text/shape.hpp"

namespace vtm::svg {

// ---- Small capitals (CSS Fonts 4 section 6.6) ---------------------------------------------------

namespace {

/// Unicode's cases, whatever locale the process has; without that locale ASCII's.
locale_t unicodeLocale() {
    static const locale_t made = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    static const locale_t ascii = newlocale(LC_CTYPE_MASK, "C", nullptr);
    return made ? made : ascii;
}

char32_t upperCase(char32_t code) {
    return static_cast<char32_t>(towupper_l(static_cast<wint_t>(code), unicodeLocale()));
}
char32_t lowerCase(char32_t code) {
    return static_cast<char32_t>(towlower_l(static_cast<wint_t>(code), unicodeLocale()));
}

/// Letters that an element wants as small capitals and that its font does not have so.
struct Made {
    bool lower = false, upper = false;

    bool holds(char32_t code) const {
        return (lower && upperCase(code) != code) || (upper && lowerCase(code) != code);
    }
};

Made madeIn(const TextElement& element, text::FontSet& fonts) {
    const Style& style = element.scope.style;
    const FontVariants caps = style.fontVariants & variantsOf(VariantGroup::Caps);
    const auto font = caps && style.synthesizeSmallCaps ? fonts.primary(fontQuery(element)) : nullptr;
    Made made;
    for (const text::Feature& feature : featuresOf(font ? caps : 0)) {
        const bool lower = feature.tag == fontTag("smcp") || feature.tag == fontTag("pcap");
        const bool upper = feature.tag == fontTag("c2sc") || feature.tag == fontTag("c2pc");
        const bool missing = (lower || upper) && !text::hasFeature(*font, feature.tag);
        made.lower |= lower && missing;
        made.upper |= upper && missing;
    }
    return made;
}

TextElement smallCapsIn(const TextElement& around, int parent) {
    TextElement made = around;
    made.parent = parent;
    made.smallCaps = true;
    made.lines = 0;
    made.textLength.reset();
    made.scope.style.unicodeBidi = UnicodeBidi::Normal;
    made.scope.style.fontVariants &= ~variantsOf(VariantGroup::Caps);
    return made;
}

}  // namespace

void makeSmallCaps(TextContent& content, text::FontSet& fonts) {
    std::vector<Made> made;
    for (const TextElement& element : content.elements)
        made.push_back(madeIn(element, fonts));
    std::vector<int> inner(made.size(), -1);
    for (TextCharacter& character : content.characters) {
        const auto element = static_cast<std::size_t>(character.element);
        if (!made[element].holds(character.code))
            continue;
        if (inner[element] < 0) {
            inner[element] = static_cast<int>(content.elements.size());
            content.elements.push_back(smallCapsIn(content.elements[element], character.element));
        }
        character.code = upperCase(character.code);
        character.element = inner[element];
    }
}

// ---- Fonts and lines ----------------------------------------------------------------------------

text::FontQuery fontQuery(const TextElement& element) {
    const Style& style = element.scope.style;
    text::FontQuery query;
    query.families = familiesIn(style.fontFamily);
    query.weight = style.fontWeight;
    query.stretch = style.fontStretch;
    query.slant = style.fontSlant;
    query.variations = variationsIn(style.fontVariations);
    query.language = element.language;
    query.opticalSize = style.fontSize;
    query.synthesizeWeight = style.synthesizeWeight;
    query.synthesizeSlant = style.synthesizeSlant;
    return query;
}

namespace {

/// In the order of CSS Fonts 4 section 7.2: what comes later wins.
std::vector<text::Feature> switchedFeatures(const TextElement& element) {
    const Style& style = element.scope.style;
    std::vector<text::Feature> features = featuresOf(style.fontVariants);
    const auto turnOff = [&](std::string_view tag) { features.push_back({fontTag(tag), 0}); };
    if (style.kerning && !*style.kerning) {
        turnOff("kern");
        turnOff("vkrn");
    }
    if (element.letterSpacing != 0) {
        turnOff("liga");
        turnOff("clig");
    }
    for (const text::Feature& feature : featuresIn(style.fontFeatures))
        features.push_back(feature);
    return features;
}

double adjustedSize(const Style& style, const text::Font* font) {
    if (!style.fontSizeAdjust || !font || !(font->metrics().xHeight > 0))
        return style.fontSize;
    return style.fontSize * *style.fontSizeAdjust / (font->metrics().xHeight / font->unitsPerEm());
}

/// The height of a line of the font above its alphabetic baseline. Hanging and mathematical lines are shares
/// of the ascent, as in other renderers: few fonts say where they are.
double heightOf(Baseline baseline, const ElementFont& font) {
    constexpr double hanging = 0.8, mathematical = 0.5;
    switch (baseline) {
        case Baseline::Auto:
        case Baseline::Alphabetic:
            return 0;
        case Baseline::Middle:
            return font.primary ? font.scaled(font.primary->metrics().xHeight) / 2 : 0;
        case Baseline::Central:
            return font.central();
        case Baseline::Mathematical:
            return font.ascent() * mathematical;
        case Baseline::Hanging:
            return font.ascent() * hanging;
        case Baseline::Ideographic:
        case Baseline::TextBottom:
            return -font.descent();
        case Baseline::TextTop:
            return font.ascent();
    }
    return 0;
}

/// `baseline-shift` of one element, up. Sub and super are those of the font around it (CSS Inline 3 section
/// 4.2.3).
double shiftOf(const TextElement& element, const ElementFont& around) {
    const BaselineShift& shift = element.scope.style.baselineShift;
    if (shift.kind == BaselineShift::Kind::Length)
        return shift.length.of(element.scope.style.fontSize);
    if (!around.primary)
        return 0;
    const text::FontMetrics& metrics = around.primary->metrics();
    return shift.kind == BaselineShift::Kind::Sub ? -around.scaled(metrics.subscriptOffset)
                                                  : around.scaled(metrics.superscriptOffset);
}

/// On the baseline of the element around it.
ElementFont smallCapsFont(const TextElement& element, ElementFont font) {
    font.features = switchedFeatures(element);
    font.size *= smallCapsScale;
    font.query.opticalSize *= smallCapsScale;
    return font;
}

}  // namespace

std::vector<ElementFont> elementFonts(const std::vector<TextElement>& elements, text::FontSet& fonts) {
    std::vector<ElementFont> made;
    for (const TextElement& element : elements) {
        if (element.smallCaps) {
            made.push_back(smallCapsFont(element, made[static_cast<std::size_t>(element.parent)]));
            continue;
        }
        const Style& style = element.scope.style;
        ElementFont font;
        font.query = fontQuery(element);
        font.features = switchedFeatures(element);
        font.primary = fonts.primary(font.query);
        font.size = adjustedSize(style, font.primary.get());
        if (element.parent >= 0) {  // on `text` itself there is no line to shift from
            const ElementFont& around = made[static_cast<std::size_t>(element.parent)];
            font.shift = around.shift - shiftOf(element, around);
        }
        const bool aligned = style.alignmentBaseline != Baseline::Auto;
        const bool horizontal = elements.front().scope.style.writingMode == WritingMode::Horizontal;
        const Baseline line = aligned ? style.alignmentBaseline : style.dominantBaseline;
        font.alignment = horizontal ? heightOf(line, font) : 0;
        made.push_back(std::move(font));
    }
    return made;
}

}  // namespace vtm::svg

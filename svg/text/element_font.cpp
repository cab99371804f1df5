#include "svg/text/element_font.hpp"

#include "svg/css/font_values.hpp"
#include "svg/css/font_variants.hpp"
#include "svg/text/small_caps.hpp"

namespace vtm::svg {

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
        return shift.length.percent ? shift.length.value / 100 * element.scope.style.fontSize
                                    : shift.length.value;
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

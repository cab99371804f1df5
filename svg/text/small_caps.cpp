#include "svg/text/small_caps.hpp"

#include <clocale>
#include <cwctype>

#include "svg/css/font_variants.hpp"
#include "svg/text/element_font.hpp"
#include "text/shape.hpp"

namespace vtm::svg {
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

}  // namespace vtm::svg

/// \file
/// A text content element's style in, the font that it asks for and its lines out; and small capitals that
/// are made of capitals where a font has none (CSS Fonts 4 section 6.6).
#pragma once

#include <memory>
#include <vector>

#include "svg/text/content.hpp"

namespace vtm::svg {

/// The size of made small capitals by that of the font, as browsers have it.
constexpr double smallCapsScale = 0.7;

/// Gives the letters that are drawn as made small capitals to elements of their own inside their elements, as
/// capitals. Letters whose capital is several characters, such as U+00DF, stay as they are.
void makeSmallCaps(TextContent& content, text::FontSet& fonts);

struct ElementFont {
    text::FontQuery query;
    std::vector<text::Feature> features;
    std::shared_ptr<const text::Font> primary;  ///< null where there is no font at all
    double size = 0;                            ///< user units an em, font-size-adjust applied
    double shift = 0;      ///< down, by baseline-shift of the element and those around it, user units
    double alignment = 0;  ///< down from there, by dominant-baseline or alignment-baseline
    double baseline() const { return shift + alignment; }

    double scaled(double fontUnits) const { return primary ? fontUnits / primary->unitsPerEm() * size : 0; }
    double ascent() const { return primary ? scaled(primary->metrics().ascent) : size; }
    double descent() const { return primary ? scaled(primary->metrics().descent) : 0; }
    /// Middle between ascent and descent, above the alphabetic baseline.
    double central() const { return (ascent() - descent()) / 2; }
};

text::FontQuery fontQuery(const TextElement& element);
std::vector<ElementFont> elementFonts(const std::vector<TextElement>& elements, text::FontSet& fonts);

}  // namespace vtm::svg

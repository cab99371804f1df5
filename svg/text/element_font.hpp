/// \file
/// A text content element's style in, the font that it asks for and its lines out.
#pragma once

#include <memory>
#include <vector>

#include "svg/text/content.hpp"

namespace vtm::svg {

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

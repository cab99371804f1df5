/// \file
/// Small capitals that are made of capitals where a font has none. Source: CSS Fonts 4 section 6.6.
#pragma once

#include "svg/text/content.hpp"

namespace vtm::svg {

/// The size of made small capitals by that of the font, as browsers have it.
constexpr double smallCapsScale = 0.7;

/// Gives the letters that are drawn as made small capitals to elements of their own inside their elements, as
/// capitals. Letters whose capital is several characters, such as U+00DF, stay as they are.
void makeSmallCaps(TextContent& content, text::FontSet& fonts);

}  // namespace vtm::svg

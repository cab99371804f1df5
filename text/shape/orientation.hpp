/// \file
/// How characters stand in vertical lines. Source: UAX 50, VerticalOrientation.txt of Unicode 15.
#pragma once

namespace vtm::text {

/// True for U, Tu and Tr: upright as they are, or with the glyph that the font has for vertical lines.
bool standsUpright(char32_t character);

}  // namespace vtm::text

/// \file
/// What a `text` element says: its characters after white space is collapsed, with their positions as the
/// attributes give them, and the elements that style them. Source: SVG 2 section 11.5.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "svg/convert/scope.hpp"
#include "svg/geometry/path_measure.hpp"
#include "text/shape.hpp"

namespace vtm::svg {

/// The path of a `textPath`, in the user space of the text.
struct TextPath {
    PathMeasure measure;
    double startOffset = 0;
    bool right = false;  ///< `side`: the path is followed backwards
};

/// A text content element.
struct TextElement {
    const Element* element = nullptr;
    Scope scope;      ///< its transform is that of the `text` element
    int parent = -1;  ///< index of the element around it
    std::string language;
    unsigned lines = 0;         ///< TextLines of its own; of `text` those of the elements around it too
    TextDecoration decoration;  ///< of the lines
    bool smallCaps = false;     ///< made small capitals of the element around it, with all else of that
    int path = -1;              ///< index of the innermost textPath around its characters
    double letterSpacing = 0, wordSpacing = 0;  ///< user units
    std::optional<double> textLength;           ///< user units, >= 0
    bool stretchesGlyphs = false;               ///< lengthAdjust
};

struct TextCharacter {
    char32_t code;
    int element;                 ///< the innermost
    std::optional<double> x, y;  ///< absolute, user units
    double dx = 0, dy = 0;
    double rotate = 0;  ///< degrees
};

struct TextContent {
    std::vector<TextElement> elements;  ///< first the `text` element; parents before their children
    std::vector<TextCharacter> characters;
    std::vector<TextPath> paths;
};

/// Characters as they are collected, before white space is collapsed.
struct RawCharacter {
    char32_t code;
    int element;
    WhiteSpace whiteSpace;
    bool rendered = true;  ///< false: only separates the white space before and after it
};

/// Appends the characters of UTF-8 text. Malformed bytes are U+FFFD.
void appendCharacters(std::string_view utf8, int element, WhiteSpace whiteSpace, bool rendered,
                      std::vector<RawCharacter>& out);

/// For every raw character whether it stays: of collapsible spaces in a row, or after a space that is kept,
/// the first stays; at the start and the end of the text none (CSS Text 4 section 4.1).
std::vector<bool> keptCharacters(const std::vector<RawCharacter>& raw);

}  // namespace vtm::svg

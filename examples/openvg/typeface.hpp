/// \file
/// A font file as a VGFont, its outlines read by FreeType.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <VG/openvg.h>

namespace typeface {

/// Glyphs as vgDrawGlyphs takes them: after glyph i the pen moves on by its escapement plus adjustments[i].
struct Line {
    std::vector<VGuint> glyphs;
    std::vector<VGfloat> adjustments;  ///< along the line, in em
    VGfloat width = 0;                 ///< in em, adjustments included
};

/// Needs a current context, for its whole life. The unit of all lengths is the em.
class Typeface {
public:
    /// Throws std::runtime_error if the file is no font with outlines.
    explicit Typeface(const std::string& file);
    ~Typeface();
    Typeface(const Typeface&) = delete;
    Typeface& operator=(const Typeface&) = delete;

    /// Kerned. Makes a path for every glyph that is new.
    Line set(std::u32string_view text);

    /// Draws with the current paints; the glyph matrix maps em to surface, the pen starts at its origin.
    void draw(const Line& line, VGbitfield paintModes = VG_FILL_PATH) const;
    /// Fills with one paint across the whole line: paint moves with each glyph, unless it is moved back.
    void drawAcross(const Line& line) const;

private:
    VGuint glyph(char32_t character);

    struct File;
    std::unique_ptr<File> file_;
    VGFont font_;
    std::vector<VGfloat> advances_;  ///< of the glyphs that have been made, in em; others negative
};

}  // namespace typeface

/// \file
/// Text set on pages, whose glyphs are maps of a font's asset (vtm/asset/text_page.hpp).
///
///     vtm::font::Typesetter page(font, 600, 800);
///     page.add(U"A page of text", {50, 50, 500, 700}, {.size = 14});
///     vtm::gl::TextTexture texture(font.asset(), {page.page()});
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <vtm/asset/text_page.hpp>
#include <vtm/font/font_maps.hpp>

#pragma GCC visibility push(default)

namespace vtm::font {

/// A page needs more symbols than there are numbers for.
class LimitError : public Error {
    using Error::Error;
};

using Color = std::array<float, 4>;  ///< straight sRGB, in [0, 1]

enum class Align {
    Start,  ///< at the left, or at the right of a line that runs from right to left; at the top if vertical
    Center,
    End
};

struct Feature {
    std::string tag;     ///< four characters, as "liga"
    unsigned value = 1;  ///< 0: off
};

struct TextStyle {
    double size = 16;  ///< page units an em, > 0
    Color color{0, 0, 0, 1};
    double lineHeight = 1.2;  ///< from baseline to baseline, ems, > 0
    Align align = Align::Start;
    bool rightToLeft = false;     ///< base direction of paragraphs
    bool vertical = false;        ///< lines from top to bottom, from right to left
    std::string language = "en";  ///< BCP 47
    std::vector<Feature> features = {};
};

/// A rectangle of the page, page units, y down.
struct TextBox {
    double x = 0, y = 0, width = 0, height = 0;
};

/// UTF-8 as characters; what is malformed becomes U+FFFD.
std::u32string fromUtf8(std::string_view text);

/// Text in cells of one size, as on a terminal.
struct CellText {
    unsigned columns = 0, rows = 0;         ///< > 0, at most 65536 each
    std::u32string text = {};               ///< row by row; cells that it does not reach are blank
    double size = 16;                       ///< page units an em, > 0
    std::vector<std::uint8_t> colors = {};  ///< of the cells, in `palette`; empty: palette[0] everywhere
    std::vector<Color> palette = {{0, 0, 0, 1}};
    Color ground{0, 0, 0, 0};
};

/// Glyphs are compiled as the text needs them. Outlines that touch or overlap, as those of joined Arabic
/// letters do, become one map, so that no pixel counts them twice.
class Typesetter {
public:
    /// `font` must live as long as this. Sizes in page units, > 0. Throws std::invalid_argument.
    Typesetter(FontMaps& font, double width, double height, Color ground = {0, 0, 0, 0});
    ~Typesetter();
    Typesetter(const Typesetter&) = delete;
    Typesetter& operator=(const Typesetter&) = delete;

    /// Sets text in lines that are broken where Unicode allows it, or at line feeds, until the box is full.
    /// The first baseline lies an ascent below the top. Returns how many characters were set: the rest did
    /// not fit. A word that is longer than a line sticks out. Throws std::invalid_argument (style out of
    /// range), LimitError (more than 65535 symbols).
    std::size_t add(std::u32string_view text, const TextBox& box, const TextStyle& style = {});

    asset::TextPage page() const;

    /// A page of cells, as wide as the font's "0" and ascent + descent high. A character that the font lacks
    /// shows the font's .notdef. Throws std::invalid_argument, LimitError (more than 255 different
    /// characters).
    static asset::TextPage cells(FontMaps& font, const CellText& text);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::font

#pragma GCC visibility pop

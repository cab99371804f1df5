/// \file
/// A font as Vector Texture Maps: the outlines of its glyphs as maps of one asset, which grows as glyphs are
/// asked for. Source: Ray et al. 2005, the font engine. docs/fonts.md.
///
///     vtm::font::FontMaps font(bytes);
///     font.addCharacters(U"Vector Texture Maps");
///     const vtm::asset::Asset asset = font.asset();  // its `glyphs` say which map is which
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/error.hpp>

#pragma GCC visibility push(default)

namespace vtm::font {

/// The font cannot be used; the message says why.
class FontError : public Error {
    using Error::Error;
};

/// The place of an axis of a variable font.
struct Variation {
    std::string axis;  ///< four characters, as "wght"
    float value = 0;
};

struct Options {
    unsigned face = 0;                       ///< of a collection, from 0
    std::vector<Variation> variations = {};  ///< of axes that the font does not have: ignored
    /// Max distance of drawn and true outlines, ems; in [2^-22, 2^-8]. By default an eighth of a unit of
    /// fonts with 2048 units an em: a hundredth of a pixel at 160 pixels an em, a sixteenth of one at 1024.
    double tolerance = 1.0 / 16384;
    /// As compiler::Options has it, for a glyph that fills 1024 pixels; in [1, 1e6]. Glyphs are drawn small,
    /// so their bytes count for more.
    double nanosecondsPerByte = 1e6;
};

class Typesetter;

/// For one thread at a time.
class FontMaps {
public:
    /// `file`: OpenType, TrueType, a collection, WOFF or WOFF2; copied. Throws FontError,
    /// std::invalid_argument (options out of range).
    explicit FontMaps(std::span<const std::uint8_t> file, const Options& options = {});
    ~FontMaps();
    FontMaps(FontMaps&&) noexcept;
    FontMaps& operator=(FontMaps&&) noexcept;

    std::string family() const;
    double ascent() const;   ///< above the baseline, ems
    double descent() const;  ///< below the baseline, ems; positive as a rule
    /// Advance of a character along a horizontal line, ems; nothing if the font lacks it.
    std::optional<double> advanceOf(char32_t character) const;
    /// All characters of the font, ascending.
    std::vector<char32_t> characters() const;

    /// Compiles the glyphs of characters that have none yet. Those that the font lacks are left out and
    /// returned, in order.
    std::u32string addCharacters(std::u32string_view characters);
    /// Compiles glyphs by their numbers in the font. Throws std::out_of_range for one that the font does not
    /// have.
    void addGlyphs(std::span<const std::uint32_t> glyphs);
    std::size_t glyphCount() const;  ///< compiled so far, blank ones included

    /// Takes the glyphs of an asset that was made before of the same font with the same options, so that they
    /// need not be compiled again. Returns whether it was. `made` must be valid (asset::validate).
    bool take(const asset::AssetView& made);

    /// A copy of all that was compiled: maps, glyphs, and a specimen of at most 64 of them as the picture.
    asset::Asset asset() const;

private:
    friend class Typesetter;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vtm::font

#pragma GCC visibility pop

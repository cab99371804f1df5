/// \file
/// Fonts by family, weight, width and slant; fallback by character. Source: CSS Fonts 4 sections 2 and 5.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vtm/error.hpp>
#include <vtm/text/font_options.hpp>
#include "text/font.hpp"

namespace vtm::text {

enum class Slant { Normal, Italic, Oblique };

struct Variation {
    Tag axis;
    float value;
    friend bool operator==(const Variation&, const Variation&) = default;
};

/// Which font is asked for.
struct FontQuery {
    std::vector<std::string> families;  ///< in order of preference; generic names as CSS writes them
    double weight = 400;                ///< in [1, 1000]
    double stretch = 100;               ///< percent, > 0
    Slant slant = Slant::Normal;
    std::vector<Variation> variations;  ///< font-variation-settings; they override weight, stretch and slant
    std::string language;               ///< BCP 47; guides fallback
    double opticalSize = 0;             ///< for axis `opsz`, CSS px; 0: not set
    bool synthesizeWeight = true, synthesizeSlant = true;  ///< where the family has no such face
    friend bool operator==(const FontQuery&, const FontQuery&) = default;
};

/// The font data cannot be used; the message says why.
class FontError : public Error {
    using Error::Error;
};

/// A rule `@font-face`: the family that it defines, what its one font stands for, and for which characters.
struct FontFace {
    std::string family;
    double minWeight = 400, maxWeight = 400, minStretch = 100, maxStretch = 100;
    Slant slant = Slant::Normal;
    struct Range {
        char32_t first, last;
    };
    std::vector<Range> characters;  ///< unicode-range; empty: all
    unsigned index = 0;             ///< of a collection's faces
};

/// Fonts of one document. Faces of the options' directories and of the system are shared between sets.
/// Not safe for use by several threads at once.
class FontSet {
public:
    explicit FontSet(const FontOptions& options);
    ~FontSet();
    FontSet(const FontSet&) = delete;
    FontSet& operator=(const FontSet&) = delete;

    /// Adds a face of the document's own: sfnt, WOFF, WOFF2 or one of a collection. Throws FontError.
    void add(const FontFace& face, std::span<const std::uint8_t> bytes);

    /// The family itself, not one that stands for it, is in the set. Generic names always are.
    bool hasFamily(const std::string& family) const;

    /// The font of the first family that is there, or else what fontconfig proposes; null where the set is
    /// empty. The same pointer for the same query.
    std::shared_ptr<const Font> primary(const FontQuery& query);

    /// The first font, in the order of the query's families and then of fallback, that has all of
    /// `characters` (one cluster); else the first that has the first of them; null where there is none.
    std::shared_ptr<const Font> covering(const FontQuery& query, std::u32string_view characters);

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace vtm::text

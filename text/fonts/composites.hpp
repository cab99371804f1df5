/// \file
/// How large composite glyphs become. Source: OpenType 1.9, table glyf.
///
/// A composite may name another one many times over, and so on down: a few hundred bytes can stand for more
/// points than any machine holds. HarfBuzz limits the depth only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "text/fonts/handles.hpp"

namespace vtm::text {

/// Points and components of a glyph: ten times what the largest glyphs of Noto have.
inline constexpr std::uint32_t maxGlyphParts = 100'000;

/// Reads the font's tables as they are asked for. For one thread.
class Composites {
public:
    explicit Composites(hb_face_t* face);

    /// Points and components of the glyph and of all that it is made of, at most maxGlyphParts + 1; that,
    /// too, for one that contains itself.
    std::uint32_t partsOf(std::uint32_t glyph);
    std::uint32_t glyphs() const { return static_cast<std::uint32_t>(parts_.size()); }

private:
    std::uint32_t count(std::uint32_t glyph, int depth);
    std::uint32_t countComponents(std::size_t at, int depth);

    HbBlob glyf_, loca_;
    std::span<const std::uint8_t> glyfBytes_, locaBytes_;
    bool longOffsets_;
    std::vector<std::uint32_t> parts_;  ///< by glyph; unknown or open while it is counted
};

}  // namespace vtm::text

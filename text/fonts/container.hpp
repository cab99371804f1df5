/// \file
/// The containers of fonts on the web. Source: WOFF 1.0, WOFF 2.0.
#pragma once

#include <cstdint>
#include <span>

#include "text/fonts/handles.hpp"

namespace vtm::text {

/// What a document's font may take once it is decompressed: four times the largest fonts of Noto.
inline constexpr std::size_t maxFontBytes = 128u << 20;

/// A copy of a font or collection, out of its WOFF or WOFF2 where it is in one. Throws FontError.
HbBlob sfntOf(std::span<const std::uint8_t> bytes);

}  // namespace vtm::text

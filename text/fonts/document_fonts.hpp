/// \file
/// The fonts that a document brings along, and the containers that they come in. Source: CSS Fonts 4 section
/// 4, WOFF 1.0, WOFF 2.0.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "text/fonts/face_entry.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {

/// What a document's font may take once it is decompressed: four times the largest fonts of Noto.
inline constexpr std::size_t maxFontBytes = 128u << 20;

/// A copy of a font or collection, out of its WOFF or WOFF2 where it is in one. Throws FontError.
HbBlob sfntOf(std::span<const std::uint8_t> bytes);

class DocumentFonts {
public:
    /// Throws FontError.
    void add(const FontFace& face, std::span<const std::uint8_t> bytes);

    /// Later rules first, as they win over equal ones; empty where there is no such family.
    const std::vector<const FaceEntry*>& family(const std::string& name) const;

private:
    std::vector<std::unique_ptr<const FaceEntry>> entries_;
    std::map<std::string, std::vector<const FaceEntry*>> families_;
};

}  // namespace vtm::text

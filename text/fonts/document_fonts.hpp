/// \file
/// The fonts that a document brings along. Source: CSS Fonts 4 section 4.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "text/fonts/face_entry.hpp"

namespace vtm::text {

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

/// \file
/// What a face can stand for, known without reading its file, and how it is set up for a query. Source: CSS
/// Fonts 4 sections 5.2 (the choice within a family) and 2.
#pragma once

#include <fontconfig/fontconfig.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "text/font_set.hpp"
#include "text/fonts/face.hpp"

namespace vtm::text {

/// A variable face has ranges.
struct FaceEntry {
    std::string file;  ///< empty for a document's own
    unsigned index = 0;
    std::string family;
    double minWeight = 400, maxWeight = 400, minStretch = 100, maxStretch = 100;
    Slant slant = Slant::Normal;
    bool variable = false;
    bool color = false;
    bool forSpace = true;                   ///< its unicode-range, if it has one, holds U+0020
    std::shared_ptr<FcCharSet> characters;  ///< never null
    std::shared_ptr<const Face> ownFace;    ///< a document's own

    /// Has a glyph for all that is to be seen of a cluster; joiners and selectors need none.
    bool covers(std::u32string_view cluster) const;
};

/// The best of a family's faces for the query, by stretch, then slant, then weight, the first among equals;
/// null for no faces.
const FaceEntry* bestFace(const std::vector<const FaceEntry*>& faces, const FontQuery& query);

/// Those that cover the cluster.
std::vector<const FaceEntry*> covering(std::vector<const FaceEntry*> faces, std::u32string_view cluster);

/// The variation axes and the synthesis of a face for a query.
Instance instanceOf(const Face& face, const FaceEntry& entry, const FontQuery& query);

}  // namespace vtm::text

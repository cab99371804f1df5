/// \file
/// fontconfig's patterns in the terms of CSS.
#pragma once

#include <string>
#include <vector>

#include "text/fonts/face_entry.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {

/// Fonts that HarfBuzz cannot read are left out, and so are the named instances of variable fonts.
bool isUsable(FcPattern* pattern);

FaceEntry entryOf(FcPattern* pattern);

/// In all languages.
std::vector<std::string> familiesOf(FcPattern* pattern);

FcPatternOwner patternOf(const FontQuery& query);

}  // namespace vtm::text

/// \file
/// The variation axes and the synthesis of a face for a query.
#pragma once

#include "text/fonts/face_entry.hpp"

namespace vtm::text {

Instance instanceOf(const Face& face, const FaceEntry& entry, const FontQuery& query);

}  // namespace vtm::text

/// \file
/// SVG's notation of values, for the other text formats of ours: colours, path data, transforms, references.
#pragma once

#include "svg/css/color.hpp"           // IWYU pragma: export
#include "svg/geometry/path_data.hpp"  // IWYU pragma: export
#include "svg/geometry/transform.hpp"  // IWYU pragma: export
#include "svg/write/values.hpp"        // IWYU pragma: export
#include "svg/xml/resource.hpp"        // IWYU pragma: export

/// \file
/// Conditions of `@media` and `@supports`, for a still picture on a light screen. Source: Media Queries 4,
/// CSS Conditional 3.
#pragma once

#include <string_view>

namespace vtm::svg {

/// Whether one of the queries holds. Sizes and other features of the screen are unknown, so queries that ask
/// for them do not.
bool mediaHolds(std::string_view queries);

/// Whether we support what is asked for: `(property: value)`, `selector(…)`, and these with not, and, or.
bool supportsHolds(std::string_view condition);

}  // namespace vtm::svg

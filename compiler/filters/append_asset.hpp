/// \file
/// Pictures that commands of another picture draw.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include <vtm/asset/asset.hpp>

namespace vtm::compiler {

/// Appends what `part` holds, moved by `by`, and its commands. They draw it over what is there.
void appendAsset(const asset::Asset& part, glm::dvec2 by, asset::Asset& asset);

}  // namespace vtm::compiler

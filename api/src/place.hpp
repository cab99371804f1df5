/// \file
/// Parts of a scene moved to another place. Each is a copy; what is shared in it stays so only below
/// patterns.
#pragma once

#include <memory>

#include <vtm/scene/scene.hpp>

namespace vtm {

/// `part` itself, which may be null, under the identity.
std::shared_ptr<const scene::Clip> placed(const std::shared_ptr<const scene::Clip>& part,
                                          const scene::Affine& transform);
std::shared_ptr<const scene::Mask> placed(const std::shared_ptr<const scene::Mask>& part,
                                          const scene::Affine& transform);

}  // namespace vtm

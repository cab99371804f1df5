/// \file
/// Parts of a scene moved to another place. Each is a copy; what is shared in it stays so only below
/// patterns.
#pragma once

#include <memory>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {

/// `part` itself, which may be null, under the identity.
std::shared_ptr<const Clip> placed(const std::shared_ptr<const Clip>& part, const Affine& transform);
std::shared_ptr<const Mask> placed(const std::shared_ptr<const Mask>& part, const Affine& transform);

Group placed(Group part, const Affine& transform);

}  // namespace vtm::scene

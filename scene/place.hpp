/// \file
/// How deep a recursion over a scene or a tree of VTMs is; and parts of a scene moved to another place. Each
/// is a copy; what is shared in it stays so only below patterns.
#pragma once

#include <memory>
#include <string>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {

/// One level further in for as long as it lives. Throws InvalidScene beyond what a valid scene may
/// have.
class Level {
public:
    explicit Level(int& depth) : depth_(depth) {
        if (depth_ >= maxNesting)
            throw InvalidScene("selections, layers, clips or masks nest more than " +
                               std::to_string(maxNesting) + " levels deep");
        ++depth_;
    }
    ~Level() { --depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

private:
    int& depth_;
};

/// `part` itself, which may be null, under the identity.
std::shared_ptr<const Clip> placed(const std::shared_ptr<const Clip>& part, const Affine& transform);
std::shared_ptr<const Mask> placed(const std::shared_ptr<const Mask>& part, const Affine& transform);
std::shared_ptr<const Filter> placed(const std::shared_ptr<const Filter>& part, const Affine& transform);

Group placed(Group part, const Affine& transform);

}  // namespace vtm::scene

/// \file
/// Counts how deep a recursion over a scene or a tree of VTMs is.
#pragma once

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

}  // namespace vtm::scene

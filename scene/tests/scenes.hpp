/// \file
/// Small valid scenes to start from.
#pragma once

#include <memory>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {

inline std::shared_ptr<const Path> unitSquare() {
    return std::make_shared<const Path>(rectangle({0, 0}, {1, 1}));
}

inline Item redSquare() { return {unitSquare(), identity, FillRule::NonZero, Color{1, 0, 0, 1}}; }

inline Scene sceneOf(Item item) {
    Scene s;
    s.width = 20;
    s.height = 10;
    s.root.children.push_back({std::move(item)});
    return s;
}

inline LinearGradient ramp() {
    return {{0, 0}, {1, 0}, {{0, Color{0, 0, 0, 1}}, {1, Color{1, 1, 1, 1}}}, Spread::Pad, identity};
}

inline RadialGradient rings() {
    return {{0, 0},          2,       {1, 0}, 0.5, {{0, Color{0, 0, 0, 1}}, {1, Color{1, 1, 1, 1}}},
            Spread::Reflect, identity};
}

}  // namespace vtm::scene

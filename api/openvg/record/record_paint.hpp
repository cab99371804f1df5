/// \file
/// Paints of OpenVG as paints of a scene: straight sRGB colours, ramps as stops, images as bitmaps.
#pragma once

#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>

#include <vtm/scene/scene.hpp>
#include "api/openvg/paint/color.hpp"
#include "api/openvg/state/objects.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

/// The bitmaps of a recording, each kept once however often it is drawn.
class Bitmaps {
public:
    std::shared_ptr<const image::Bitmap> add(image::Bitmap bitmap);

private:
    std::vector<std::shared_ptr<const image::Bitmap>> bitmaps_;
};

/// `matrix` is affine.
scene::Affine affineOf(const glm::mat3& matrix);

/// A colour that a program gave, clamped, not transformed.
scene::Color clearColor(const State& state);

/// A group of one node.
std::shared_ptr<const scene::Group> groupOf(scene::Node node);

/// What shows where `shape` is inside: an item, or for patterns with a colour around them two in one place.
scene::Node painted(const scene::Shape& shape, const Paint& paint, const scene::Affine& paintToUser,
                    const State& state, Bitmaps& bitmaps);

/// An image over its own rectangle.
scene::Node painted(const Image& image, const scene::Affine& toPicture, const State& state, Bitmaps& bitmaps);

/// Whether nothing shows through.
bool isOpaque(const scene::Node& node);

}  // namespace vtm::openvg

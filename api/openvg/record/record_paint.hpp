/// \file
/// Paints of OpenVG as paints of a scene: straight sRGB colours, ramps as stops, images as bitmaps.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>

#include <vtm/scene/scene.hpp>
#include "api/openvg/image/pixels.hpp"
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
/// With a paint's colour transform (VG_DRAW_IMAGE_COLOR_MATRIX_NDS).
scene::Node transformed(const Image& image, const Paint& paint, const scene::Affine& toPicture,
                        const State& state, Bitmaps& bitmaps);
/// Multiplied by one colour.
scene::Node multiplied(const Image& image, Color color, const scene::Affine& toPicture, const State& state,
                       Bitmaps& bitmaps);
/// White, with an image's alpha.
scene::Node alphaOf(const Image& image, const scene::Affine& toPicture, const State& state, Bitmaps& bitmaps);
/// An image as it is, without alpha.
scene::Node opaque(const Image& image, const scene::Affine& toPicture, const State& state, Bitmaps& bitmaps);

/// A part of an image as stored, pixel for pixel; no colour transform takes part.
scene::ImagePaint storedPart(const Image& image, const CopyArea& area, Bitmaps& bitmaps);
/// White, with the values of a part of a mask, or with what they leave of 1.
scene::ImagePaint storedPart(const MaskValues& values, const CopyArea& area, bool isRest, Bitmaps& bitmaps);

/// What a paint is everywhere, straight sRGB; nothing for gradients and patterns.
std::optional<Color> colorOf(const Paint& paint);

/// Whether every pixel is white, but for its alpha: what stencils of all channels alike are.
bool isWhite(const Image& image);

/// Whether nothing shows through.
bool isOpaque(const scene::Node& node);

}  // namespace vtm::openvg

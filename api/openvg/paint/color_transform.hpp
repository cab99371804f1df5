/// \file
/// The colour transform of paints (VG_NDS_paint_generation, section 9.5 there).
#pragma once

#include <memory>

#include <glm/mat4x4.hpp>

#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/paint/color.hpp"
#include "api/openvg/state/objects.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

/// VG_COLOR_TRANSFORM of a context (section 13.1 of OpenVG 1.1).
class ScaleAndBias {
public:
    explicit ScaleAndBias(const State& state);

    bool isOn() const { return isOn_; }
    /// Of a colour that is not premultiplied.
    Color operator()(Color color) const { return clampedToUnit(color * scale_ + bias_); }

private:
    bool isOn_;
    Color scale_, bias_;
};

class ColorTransform {
public:
    explicit ColorTransform(const Paint& paint);

    /// Colours pass as they are.
    bool isIdentity() const { return isIdentity_; }
    /// Of what operator() takes and gives: not premultiplied.
    ColorSpace space() const { return space_; }
    /// Clamps its result to [0, 1].
    Color operator()(Color color) const;

private:
    glm::mat4 matrix_;
    Color added_;
    ColorSpace space_;
    bool isIdentity_;
};

/// A colour of a paint's parameters, clamped to [0, 1] and transformed, in a space that is not premultiplied.
Color transformedColor(const ColorTransform& transform, Color sRGBAColor, ColorSpace to);

/// All colours transformed. `source` as it is if the transform is the identity.
std::unique_ptr<PixelSource> transformedSource(std::unique_ptr<PixelSource> source,
                                               const ColorTransform& transform);

}  // namespace vtm::openvg

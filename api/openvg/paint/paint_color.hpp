/// \file
/// Colours of a paint: along a gradient (specification section 9.3.3), and transformed
/// (VG_NDS_paint_generation, section 9.5 there).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>

#include <VG/openvg.h>

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
    Color scale() const { return scale_; }
    Color bias() const { return bias_; }

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

    const glm::mat4& matrix() const { return matrix_; }
    Color added() const { return added_; }

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

class ColorRamp {
public:
    explicit ColorRamp(const Paint& paint);

    /// Of the first stop, that of offset 0 if none is given: as at() gives them.
    Color first() const {
        return premultiplied_ ? stops_.front().color : premultiplied(stops_.front().color);
    }

    /// Of what at() gives: premultiplied, sRGBA unless the paint's ramp is linear (VG_NDS_paint_generation).
    ColorSpace space() const { return space_; }

    /// At a gradient's value, any number.
    Color at(double offset) const {
        Color color;
        row(std::span(&offset, 1), std::span(&color, 1));
        return color;
    }
    void row(std::span<const double> offsets, std::span<Color> colors) const;

    VGColorRampSpreadMode spread() const { return spread_; }
    /// Whether stops are mixed as premultiplied colours.
    bool isPremultiplied() const { return premultiplied_; }

    struct Stop {
        float offset;
        Color color;  ///< premultiplied if the ramp's are
    };
    /// From offset 0 to 1, at least two.
    const std::vector<Stop>& stops() const { return stops_; }
    /// As at(), of a place between two neighbours: 0 at a, 1 at b.
    Color between(const Stop& a, const Stop& b, float t) const {
        const Color color = glm::mix(a.color, b.color, t);
        return premultiplied_ ? color : premultiplied(color);
    }

    /// Where colours are `start + t * change`, t being 0 at `origin`.
    struct Piece {
        double low, high;  ///< half open
        double origin, scale;
        Color start, change;
    };
    /// Of all numbers, in order.
    const std::vector<Piece>& pieces() const { return pieces_; }

private:
    const Piece& pieceAt(double offset) const;
    template <bool premultiplies, class Spread>
    void walk(std::span<const double> offsets, std::span<Color> colors, Spread&& spread) const;

    std::vector<Stop> stops_;
    std::vector<Piece> pieces_;
    ColorSpace space_;
    VGColorRampSpreadMode spread_;
    bool premultiplied_;  ///< colours of stops are, and so is what lies between
};

}  // namespace vtm::openvg

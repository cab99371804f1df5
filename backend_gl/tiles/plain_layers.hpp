/// \file
/// A paint program near a tile in; out come the gradients that it draws over each other, each with what is
/// made of its colours.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include "asset/records.hpp"
#include "backend_gl/tiles/plain_gradient.hpp"

namespace vtm::gl::plain {

/// What is made of a colour c, with another one.
struct Step {
    enum class Kind {
        Scale,  ///< c times color.a
        Onto,   ///< c over the colour
        Under,  ///< the colour over c
        Mix,    ///< c mixed with the colour below it
        MixOn,  ///< the colour mixed with c below it
        Mask    ///< the colour times what the mask c leaves
    };
    Kind kind;
    glm::dvec4 color;
    asset::Blend blend = asset::Blend::Normal;
    asset::Op mask = asset::Op::PopMaskAlpha;

    glm::dvec4 operator()(const glm::dvec4& c) const;
};

/// A colour, or a gradient and what is made of it.
struct PlainLayer {
    glm::dvec4 color{0};
    std::shared_ptr<const Ramp> ramp;  ///< null: a colour
    Place place;
    Interval range{};  ///< of offsets in the tile's pixels
    bool isOpaque = false;
    std::vector<Step> steps;

    bool isColor() const { return !ramp; }
    glm::dvec4 at(double u) const;
    void add(const Step& step);
};

using Layers = std::vector<PlainLayer>;

/// From the lowest on; only that one may be a colour. Nothing where it cannot be told so.
std::optional<Layers> plainLayers(const asset::AssetView& asset, const asset::Paint& program,
                                  const TileFrame& frame);

}  // namespace vtm::gl::plain

/// \file
/// The author's model: a Vector Texture Map is nothing, a paint over the whole plane, one of two VTMs chosen
/// at every point by a mask, or one VTM laid over another.
///
///     const Vtm sign = Vtm::select(filled(triangle), Vtm::material("rust", glsl, orange), meadow);
///     const compiler::Result result = compile(sign, 64, 64);
///
/// Source: Ray et al. 2005, the shader algebra b·c1 + (1-b)·c2 and VTMs of VTMs. Pictures in painter's order
/// are the same thing: T_i = select(mask_i, over(paint_i, T_{i-1}), T_{i-1}), which fromScene makes of what
/// importers hand over and toScene undoes.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm {

/// Where a mask is inside. Its path must be there.
using Mask = scene::Shape;

Mask filled(scene::Path path, scene::FillRule rule = scene::FillRule::NonZero);
Mask stroked(scene::Path path, scene::StrokeStyle style);

/// How a layer meets what lies below it; a scene::Group without its children.
struct Compositing {
    float opacity = 1;
    scene::BlendMode blend = scene::BlendMode::Normal;
    std::shared_ptr<const scene::Clip> clip = nullptr;
    std::shared_ptr<const scene::Mask> mask = nullptr;
};

struct VtmNode;

/// An immutable value, cheap to copy: copies share their parts, and a part may stand in a tree many times.
/// Values are not checked before a scene is made of them.
class Vtm {
public:
    /// Nothing: transparent everywhere. As one side of a selection it makes the other a primitive of its own.
    Vtm() = default;

    /// A colour, gradient, pattern, image or material over the whole plane.
    static Vtm paint(scene::Paint paint, float opacity = 1);
    /// `glsl` defines `vec4 NAME(vec2 p)`: scene::Material.
    static Vtm material(std::string name, std::string glsl, const scene::Color& fallback);
    static Vtm image(image::Bitmap bitmap, scene::ImageFilter filter = scene::ImageFilter::Trilinear);

    /// `inside` where the mask is inside, `outside` elsewhere: a choice, so a translucent inside does not
    /// show the outside.
    static Vtm select(Mask mask, Vtm inside, Vtm outside = {});
    static Vtm over(Vtm top, Vtm below);
    /// `top`, isolated, and composited with what is below.
    static Vtm layer(Vtm top, Vtm below, Compositing how);

    /// Moved, masks and paints together: `transform` maps it to where it now stands.
    Vtm placed(const scene::Affine& transform) const;

    /// The scene, which must be valid, as selections in painter's order; its size is forgotten.
    static Vtm fromScene(const scene::Scene& scene);
    /// A picture of what lies in [0, width] × [0, height]. Layers of a chain as fromScene makes it become a
    /// scene's items again, one each. Throws scene::InvalidScene where selections nest beyond
    /// scene::maxNesting; the scene is not checked otherwise.
    scene::Scene toScene(double width, double height) const;

    /// For looking inside; null for nothing.
    const VtmNode* node() const { return node_.get(); }
    /// The same node, not one that looks alike.
    friend bool operator==(const Vtm&, const Vtm&) = default;

private:
    friend struct VtmNode;
    explicit Vtm(VtmNode node);
    std::shared_ptr<const VtmNode> node_;
};

struct PaintNode {
    scene::Paint paint;
    float opacity = 1;
};
struct SelectNode {
    Mask mask;
    Vtm inside, outside;
};
struct LayerNode {
    Vtm top, below;
    Compositing how;
};
struct PlacedNode {
    Vtm content;
    scene::Affine transform;
};

struct VtmNode {
    std::variant<PaintNode, SelectNode, LayerNode, PlacedNode> value;

    explicit VtmNode(std::variant<PaintNode, SelectNode, LayerNode, PlacedNode> v) : value(std::move(v)) {}
    VtmNode(VtmNode&&) = default;
    VtmNode& operator=(VtmNode&&) = default;
    ~VtmNode();  ///< without recursion: a picture of a million items is a chain of as many nodes
};

/// The part [0, width] × [0, height] of the plane as an asset. Throws what compiler::compile throws.
compiler::Result compile(const Vtm& vtm, double width, double height, const compiler::Options& options = {});

}  // namespace vtm

#pragma GCC visibility pop

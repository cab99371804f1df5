/// \file
/// The author's model: a Vector Texture Map is nothing, a paint over the whole plane, one of two VTMs chosen
/// at every point by a mask, or one VTM laid over another.
///
///     const Vtm sign = Vtm::select(filled(triangle), Vtm::material("rust", glsl, orange), meadow);
///     const compiler::Result result = compile(sign, 64, 64);
///
/// Source: Ray et al. 2005, the shader algebra b·c1 + (1-b)·c2 and VTMs of VTMs. Pictures in painter's order
/// have the same form: T_i = select(mask_i, over(paint_i, T_{i-1}), T_{i-1}). fromScene converts the
/// importers' scenes to it, and toScene converts back.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include <vtm/compiler/compile.hpp>
#include <vtm/scene/scene.hpp>

#pragma GCC visibility push(default)

namespace vtm {

/// The shape of a mask. Its path must not be null.
using Mask = scene::Shape;

Mask filled(scene::Path path, scene::FillRule rule = scene::FillRule::NonZero);
Mask stroked(scene::Path path, scene::StrokeStyle style);

/// How a layer is composited with the content below it: a scene::Group without its children.
struct Compositing {
    float opacity = 1;
    scene::BlendMode blend = scene::BlendMode::Normal;
    std::shared_ptr<const scene::Clip> clip = nullptr;
    std::shared_ptr<const scene::Mask> mask = nullptr;
    std::shared_ptr<const scene::Filter> filter = nullptr;

    /// Source over, as it is.
    bool isPlain() const {
        return opacity == 1 && blend == scene::BlendMode::Normal && !clip && !mask && !filter;
    }
};

struct VtmNode;

/// An immutable value, cheap to copy: copies share their parts, and a tree may contain a part many times.
/// Values are checked only when they become a scene.
class Vtm {
public:
    /// The empty VTM, transparent everywhere. As one side of a selection it turns the other side into a
    /// primitive.
    Vtm() = default;

    /// A colour, gradient, pattern, image or material over the whole plane.
    static Vtm paint(scene::Paint paint, float opacity = 1);
    /// A procedural paint over the whole plane. `glsl` defines `vec4 NAME(vec2 p)` as in scene::Material.
    static Vtm material(std::string name, std::string glsl, const scene::Color& fallback);
    static Vtm image(image::Bitmap bitmap, scene::ImageFilter filter = scene::ImageFilter::Trilinear);

    /// Shows `inside` inside the mask and `outside` elsewhere. It is a choice, not a layer: a translucent
    /// `inside` does not show `outside`.
    static Vtm select(Mask mask, Vtm inside, Vtm outside = {});
    static Vtm over(Vtm top, Vtm below);
    /// `top` as an isolated group, composited with `below`.
    static Vtm layer(Vtm top, Vtm below, Compositing how);

    /// This VTM, masks and paints, mapped by `transform`.
    Vtm placed(const scene::Affine& transform) const;

    /// Converts a scene to selections in painter's order. The scene must be valid; its size is dropped.
    static Vtm fromScene(const scene::Scene& scene);
    /// Returns a scene of the part in [0, width] × [0, height] (user units). A chain of layers as made by
    /// fromScene becomes one item per layer again. Throws scene::InvalidScene if selections nest deeper than
    /// scene::maxNesting; the scene is not checked otherwise.
    scene::Scene toScene(double width, double height) const;

    /// The root node, for inspection; null for the empty VTM. Owned by this value.
    const VtmNode* node() const { return node_.get(); }
    /// Compares identity: equal only if both share the same node.
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
    ~VtmNode();  ///< iterative: a picture of a million items is a chain of a million nodes
};

/// Compiles the part [0, width] × [0, height] of the plane, user units. Throws as compiler::compile does.
compiler::Result compile(const Vtm& vtm, double width, double height, const compiler::Options& options = {});

}  // namespace vtm

#pragma GCC visibility pop

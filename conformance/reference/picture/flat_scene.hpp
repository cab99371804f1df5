/// \file
/// A scene made ready for one view: edges in pixels, and flat lists in place of the tree.
#pragma once

#include <memory>
#include <vector>

#include <vtm/scene/scene.hpp>
#include "conformance/reference/outline/edges.hpp"
#include "conformance/reference/paint/shader.hpp"

namespace vtm::reference {

inline constexpr int noIndex = -1;

/// An outline with an inside. It belongs to a tree, where it is a layer, or to a clip.
struct Shape {
    scene::FillRule rule;
    bool ofClip;
    int owner;  ///< index of the tree or the clip
    int place;  ///< index among the owner's layers or shapes
};

/// A paint inside a shape.
struct Layer {
    int shape, group, shader;
    double opacity;
    bool hides;  ///< opaque and blended straight with its tree's root: nothing below it shows
};

struct GroupNode {
    int parent, depth;
    double opacity = 1;
    scene::BlendMode blend = scene::BlendMode::Normal;
    int clip = noIndex, mask = noIndex;
    bool outside = false;  ///< shown where the clip is not
};

/// Layers in painter's order; group 0 is the root. Groups that change nothing are dissolved.
struct Tree {
    std::vector<Layer> layers;
    std::vector<GroupNode> groups;
};

struct ClipNode {
    struct Part {
        int shape, clip;
    };
    std::vector<Part> parts;
    int clip = noIndex;
};

struct MaskNode {
    int tree;
    scene::MaskKind kind;
    bool linear;
};

struct FlatScene {
    int width = 0, height = 0;
    std::vector<Shape> shapes;
    std::vector<Edge> edges;  ///< a shape's edges stand together, in the order of the shapes
    std::vector<Tree> trees;  ///< tree 0 is the picture; the others are masks
    std::vector<ClipNode> clips;
    std::vector<MaskNode> masks;
    std::vector<Shader> shaders;
};

enum class Patterns {
    LaidOut,  ///< as geometry, tile by tile; sampled where those are too many
    Sampled   ///< as paints
};

/// What lies outside the scene's rectangle is cut off by a clip of the root.
FlatScene flattenScene(const scene::Scene& scene, const View& view, double flatness, Patterns patterns,
                       const MaterialFunction& materials);
/// A group, not cut off by anything.
FlatScene flattenGroup(const scene::Group& group, const View& view, double flatness, Patterns patterns,
                       const MaterialFunction& materials);

}  // namespace vtm::reference

#include "conformance/reference/picture/flat_scene.hpp"

#include <array>
#include <map>
#include <utility>

#include <vtm/limits/limits.hpp>
#include "conformance/reference/outline/stroke.hpp"
#include "conformance/reference/paint/tiling.hpp"

namespace vtm::reference {
namespace {

/// Pixels a side of a pattern's tile. A tile that is larger in the view has larger pixels, which
/// changes nothing but the cost of finding the edges near a point.
constexpr double maxTileSide = 4096;

/// Items of all tiles of a pattern together, beyond which its tiles are sampled rather than laid out.
constexpr double maxTiledItems = 1 << 16;

bool isPlain(const scene::Group& group) {
    return group.opacity == 1 && group.blend == scene::BlendMode::Normal && !group.clip && !group.mask;
}

/// Whether a blend mode inside could see, past this group, what lies below it.
bool blendsInside(const scene::Group& group) {
    for (const scene::Node& node : group.children) {
        const auto* child = std::get_if<scene::Group>(&node.value);
        if (child && (child->blend != scene::BlendMode::Normal || (isPlain(*child) && blendsInside(*child))))
            return true;
    }
    return false;
}

bool isOpaque(const Shader& shader) {
    if (const auto* solid = std::get_if<SolidShader>(&shader))
        return solid->colour.a >= 1;
    if (const auto* linear = std::get_if<LinearShader>(&shader))
        return linear->ramp.isOpaque();
    return false;
}

std::shared_ptr<const scene::Clip> rectangleClip(Point min, Point max) {
    auto clip = std::make_shared<scene::Clip>();
    auto path = std::make_shared<scene::Path>(scene::rectangle(min, max));
    clip->shapes.push_back({std::move(path), scene::identity, scene::FillRule::NonZero, nullptr});
    return clip;
}

class Maker {
public:
    Maker(const View& view, double flatness, Patterns patterns, const MaterialFunction& materials)
        : view_(view),
          flatness_(flatness),
          patterns_(patterns),
          materials_(materials),
          edges_(view.width, view.height) {
        picture_.width = view.width;
        picture_.height = view.height;
    }

    void addRoot(const scene::Group& root, std::shared_ptr<const scene::Clip> frame) {
        const int tree = newTree(frame);
        addGroup(root, tree, 0);
    }

    FlatScene take() {
        picture_.edges = edges_.take();
        return std::move(picture_);
    }

private:
    int newTree(const std::shared_ptr<const scene::Clip>& clip) {
        const int tree = int(picture_.trees.size());
        picture_.trees.emplace_back();
        GroupNode root{noIndex, 0};
        root.clip = clipOf(clip);
        picture_.trees[std::size_t(tree)].groups.push_back(root);
        return tree;
    }

    void addGroup(const scene::Group& group, int tree, int parent) {
        int place = parent;
        if (!isPlain(group) || blendsInside(group)) {
            // The clip and the mask may make trees: no reference into the lists lives across them.
            GroupNode node{parent, groupsOf(tree)[std::size_t(parent)].depth + 1, group.opacity, group.blend};
            node.clip = clipOf(group.clip);
            node.mask = maskOf(group.mask);
            place = int(groupsOf(tree).size());
            groupsOf(tree).push_back(node);
        }
        for (const scene::Node& child : group.children) {
            limits::check();
            if (const auto* item = std::get_if<scene::Item>(&child.value))
                addItem(*item, tree, place);
            else if (const auto* select = std::get_if<scene::Select>(&child.value))
                addSelect(*select, tree, place);
            else
                addGroup(std::get<scene::Group>(child.value), tree, place);
        }
    }

    /// Two groups in one, cut by the mask and by its complement, whose shares of a pixel add up.
    void addSelect(const scene::Select& select, int tree, int parent) {
        const int both = pushGroup(tree, parent, noIndex);
        const int mask =
            clipOf(scene::Item{select.mask.path, select.mask.transform, select.mask.geometry, {}});
        const int inside = pushGroup(tree, both, mask);
        if (select.inside)
            addGroup(*select.inside, tree, inside);
        const int outside = pushGroup(tree, both, mask);
        groupsOf(tree)[std::size_t(outside)].outside = true;
        groupsOf(tree)[std::size_t(outside)].blend = scene::BlendMode::PlusLighter;
        if (select.outside)
            addGroup(*select.outside, tree, outside);
    }

    std::vector<GroupNode>& groupsOf(int tree) { return picture_.trees[std::size_t(tree)].groups; }

    void addItem(const scene::Item& item, int tree, int group) {
        const auto* pattern = std::get_if<scene::Pattern>(&item.paint);
        if (pattern && patterns_ == Patterns::LaidOut && addTiles(item, *pattern, tree, group))
            return;
        const int shader = addShader(item.paint, toPixels(item));
        std::vector<Layer>& layers = picture_.trees[std::size_t(tree)].layers;
        const bool hides = group == 0 && item.opacity >= 1 && isOpaque(picture_.shaders[std::size_t(shader)]);
        const int shape = addShape({ruleOf(item), false, tree, int(layers.size())});
        layers.push_back({shape, group, shader, item.opacity, hides});
        addOutline(item, shape, edges_);
    }

    Affine toPixels(const scene::Item& item) const { return scene::compose(view_.toPixels, item.transform); }

    static scene::FillRule ruleOf(const scene::Item& item) {
        const auto* fill = std::get_if<scene::FillRule>(&item.geometry);
        return fill ? *fill : scene::FillRule::NonZero;
    }

    void addOutline(const scene::Item& item, int shape, EdgeList& edges) const {
        if (const auto* stroke = std::get_if<scene::StrokeStyle>(&item.geometry))
            addStroke(*item.path, *stroke, toPixels(item), view_, flatness_, shape, edges);
        else
            addFill(*item.path, toPixels(item), view_, flatness_, shape, edges);
    }

    /// A pattern as a group clipped by the item, with a clipped group for each tile. False, with nothing
    /// added, if there are too many.
    bool addTiles(const scene::Item& item, const scene::Pattern& pattern, int tree, int group) {
        EdgeList outline(view_.width, view_.height);
        addOutline(item, 0, outline);
        const auto tiles =
            tilesMeeting(outline.bounds(), pattern, scene::compose(toPixels(item), pattern.transform),
                         maxTiledItems / double(itemCount(*pattern.content)));
        if (!tiles)
            return false;
        const int all = pushGroup(tree, group, clipOf(item));
        groupsOf(tree)[std::size_t(all)].opacity = item.opacity;
        for (const Affine& tile : *tiles)
            addTile(pattern, tile, tree, all);
        return true;
    }

    /// What is made for one tile is placed for that tile, clips and masks too.
    void addTile(const scene::Pattern& pattern, const Affine& tileToPixels, int tree, int parent) {
        const Affine outside = std::exchange(view_.toPixels, tileToPixels);
        auto clips = std::exchange(clips_, {});
        auto masks = std::exchange(masks_, {});
        const auto border = rectangleClip(pattern.min, pattern.max);
        addGroup(*pattern.content, tree, pushGroup(tree, parent, clipOf(border)));
        view_.toPixels = outside;
        clips_ = std::move(clips);
        masks_ = std::move(masks);
    }

    int pushGroup(int tree, int parent, int clip) {
        GroupNode node{parent, groupsOf(tree)[std::size_t(parent)].depth + 1};
        node.clip = clip;
        groupsOf(tree).push_back(node);
        return int(groupsOf(tree).size()) - 1;
    }

    int addShape(const Shape& shape) {
        picture_.shapes.push_back(shape);
        return int(picture_.shapes.size()) - 1;
    }

    /// By an item's outline.
    int clipOf(const scene::Item& item) {
        const int clip = int(picture_.clips.size());
        picture_.clips.push_back({{{addShape({ruleOf(item), true, clip, 0}), noIndex}}, noIndex});
        addOutline(item, picture_.clips.back().parts[0].shape, edges_);
        return clip;
    }

    int clipOf(const std::shared_ptr<const scene::Clip>& clip) {
        if (!clip)
            return noIndex;
        if (const auto known = clips_.find(clip.get()); known != clips_.end())
            return known->second;
        ClipNode node;
        node.clip = clipOf(clip->clip);
        std::vector<int> inner;
        for (const scene::ClipShape& shape : clip->shapes)
            inner.push_back(clipOf(shape.clip));
        const int index = int(picture_.clips.size());
        for (std::size_t i = 0; i < inner.size(); ++i)
            node.parts.push_back({addClipShape(clip->shapes[i], index, int(i)), inner[i]});
        picture_.clips.push_back(std::move(node));
        return clips_[clip.get()] = index;
    }

    int addClipShape(const scene::ClipShape& clip, int owner, int place) {
        const int shape = addShape({clip.rule, true, owner, place});
        addFill(*clip.path, scene::compose(view_.toPixels, clip.transform), view_, flatness_, shape, edges_);
        return shape;
    }

    int maskOf(const std::shared_ptr<const scene::Mask>& mask) {
        if (!mask)
            return noIndex;
        if (const auto known = masks_.find(mask.get()); known != masks_.end())
            return known->second;
        const int tree = newTree(nullptr);
        addGroup(*mask->content, tree, 0);
        picture_.masks.push_back({tree, mask->kind, mask->linear});
        return masks_[mask.get()] = int(picture_.masks.size()) - 1;
    }

    int addShader(const scene::Paint& paint, const Affine& toPixels) {
        picture_.shaders.push_back(std::visit([&](const auto& p) { return shaderOf(p, toPixels); }, paint));
        return int(picture_.shaders.size()) - 1;
    }

    static Shader shaderOf(const scene::Color& color, const Affine&) {
        return SolidShader{premultiplied(color)};
    }

    /// The map from the raster to a paint's space; a paint whose map has no inverse shows nothing.
    template <class Paint, class Make>
    static Shader withInverse(const Paint& paint, const Affine& toPixels, const Make& make) {
        const auto toPaint = scene::inverse(scene::compose(toPixels, paint.transform));
        return toPaint ? Shader(make(*toPaint)) : Shader(SolidShader{Colour(0)});
    }

    static Shader shaderOf(const scene::LinearGradient& g, const Affine& toPixels) {
        const Vector along = g.end - g.start;
        return withInverse(g, toPixels, [&](const Affine& toPaint) {
            return LinearShader{toPaint, g.start, along / dot(along, along), Ramp(g.stops, g.spread)};
        });
    }

    static Shader shaderOf(const scene::RadialGradient& g, const Affine& toPixels) {
        return withInverse(g, toPixels, [&](const Affine& toPaint) {
            return RadialShader{toPaint, g, Ramp(g.stops, g.spread)};
        });
    }

    static Shader shaderOf(const scene::ImagePaint& paint, const Affine& toPixels) {
        return withInverse(paint, toPixels,
                           [&](const Affine& toPaint) { return ImageShader(toPaint, paint); });
    }

    Shader shaderOf(const scene::Material& material, const Affine& toPixels) const {
        if (!materials_)
            return SolidShader{premultiplied(material.fallback)};
        return withInverse(material, toPixels, [&](const Affine& toPaint) {
            return MaterialShader{toPaint, material, materials_};
        });
    }

    Shader shaderOf(const scene::Pattern& pattern, const Affine& toPixels) {
        return withInverse(pattern, toPixels, [&](const Affine& toPaint) {
            const Vector size = pattern.max - pattern.min;
            const double scale = largestScale(scene::compose(toPixels, pattern.transform));
            const auto pixels = [&](double side) { return std::clamp(side * scale, 1.0, maxTileSide); };
            const Vector tileSize{pixels(size.x), pixels(size.y)};
            const Affine toTile = scene::compose(scene::scaling(tileSize.x / size.x, tileSize.y / size.y),
                                                 scene::translation(-pattern.min.x, -pattern.min.y));
            const double coarser = std::min(tileSize.x / size.x, tileSize.y / size.y) / scale;
            return TileShader{scene::compose(toTile, toPaint), tileSize,
                              tileOf(pattern.content, toTile, tileSize, flatness_ * coarser)};
        });
    }

    std::shared_ptr<const FlatScene> tileOf(const std::shared_ptr<const scene::Group>& content,
                                            const Affine& toTile, Vector size, double flatness) {
        const TileKey key{content.get(), {toTile[0].x, toTile[1].y, toTile[2].x, toTile[2].y}};
        std::shared_ptr<const FlatScene>& tile = tiles_[key];
        if (!tile) {
            Maker maker({int(std::ceil(size.x)), int(std::ceil(size.y)), toTile}, flatness, Patterns::Sampled,
                        materials_);
            maker.addRoot(*content, nullptr);
            tile = std::make_shared<const FlatScene>(maker.take());
        }
        return tile;
    }

    using TileKey = std::pair<const scene::Group*, std::array<double, 4>>;

    View view_;
    double flatness_;
    Patterns patterns_;
    const MaterialFunction& materials_;
    EdgeList edges_;
    FlatScene picture_;
    std::map<const scene::Clip*, int> clips_;
    std::map<const scene::Mask*, int> masks_;
    std::map<TileKey, std::shared_ptr<const FlatScene>> tiles_;
};

}  // namespace

FlatScene flattenScene(const scene::Scene& scene, const View& view, double flatness, Patterns patterns,
                       const MaterialFunction& materials) {
    Maker maker(view, flatness, patterns, materials);
    maker.addRoot(scene.root, rectangleClip({0, 0}, {scene.width, scene.height}));
    return maker.take();
}

FlatScene flattenGroup(const scene::Group& group, const View& view, double flatness, Patterns patterns,
                       const MaterialFunction& materials) {
    Maker maker(view, flatness, patterns, materials);
    maker.addRoot(group, nullptr);
    return maker.take();
}

}  // namespace vtm::reference

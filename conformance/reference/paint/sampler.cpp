#include "conformance/reference/paint/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "conformance/reference/coverage/coverage.hpp"
#include "conformance/reference/paint/composite.hpp"

namespace vtm::reference {
namespace {

/// Entries in a tile's index of edges by rows; fewer, higher rows where there would be more.
constexpr std::size_t maxRowEntries = std::size_t(1) << 24;

void toggle(std::vector<int>& ascending, int value) {
    const auto at = std::lower_bound(ascending.begin(), ascending.end(), value);
    if (at != ascending.end() && *at == value)
        ascending.erase(at);
    else
        ascending.insert(at, value);
}

}  // namespace

/// Composites over a spot: groups are colours on the sampler's stack.
struct PointCanvas {
    Sampler& sampler;
    const Spot& spot;

    void open(const GroupNode&) { sampler.stack_.emplace_back(0); }
    void draw(const Layer& layer) {
        const Colour colour = sampler.shade(layer.shader, spot) * layer.opacity;
        sampler.stack_.back() = over(sampler.stack_.back(), colour);
    }
    void close(const GroupNode& group) {
        Colour colour = sampler.stack_.back() * group.opacity;
        sampler.stack_.pop_back();
        if (colour.a > 0 && group.clip != noIndex && sampler.insideClip(group.clip) == group.outside)
            colour = Colour(0);
        if (colour.a > 0 && group.mask != noIndex)
            colour *= sampler.maskOver(group.mask, spot);
        if (group.parent == noIndex)
            sampler.stack_.push_back(colour);
        else
            sampler.stack_.back() = blend(group.blend, sampler.stack_.back(), colour);
    }
};

Sampler::Sampler(const FlatScene& picture)
    : picture_(picture),
      windings_(picture.shapes.size()),
      layers_(picture.trees.size()),
      parts_(picture.clips.size()),
      tiles_(picture.shaders.size()) {}

void Sampler::cross(int index, int winding) {
    const Shape& shape = picture_.shapes[std::size_t(index)];
    int& current = windings_[std::size_t(index)];
    const bool before = isInside(current, shape.rule);
    current += winding;
    if (isInside(current, shape.rule) != before)
        toggle((shape.ofClip ? parts_ : layers_)[std::size_t(shape.owner)], shape.place);
}

Colour Sampler::colourOver(const Spot& spot) {
    variation_ = Variation::Constant;
    return treeColour(0, spot);
}

Colour Sampler::treeColour(int index, const Spot& spot) {
    const Tree& tree = picture_.trees[std::size_t(index)];
    const std::vector<int>& layers = layers_[std::size_t(index)];
    std::size_t first = layers.size();
    while (first > 0 && !tree.layers[std::size_t(layers[--first])].hides) {
    }
    PointCanvas canvas{*this, spot};
    composite(tree, std::span(layers).subspan(first), canvas);
    const Colour colour = stack_.back();
    stack_.pop_back();
    return colour;
}

bool Sampler::insideClip(int index) const {
    const ClipNode& clip = picture_.clips[std::size_t(index)];
    const std::vector<int>& around = parts_[std::size_t(index)];
    const bool inside = std::any_of(around.begin(), around.end(), [&](int part) {
        const int inner = clip.parts[std::size_t(part)].clip;
        return inner == noIndex || insideClip(inner);
    });
    return inside && (clip.clip == noIndex || insideClip(clip.clip));
}

double Sampler::maskOver(int index, const Spot& spot) {
    const MaskNode& mask = picture_.masks[std::size_t(index)];
    const Colour colour = treeColour(mask.tree, spot);
    return mask.kind == scene::MaskKind::Alpha ? colour.a : luminance(colour, mask.linear);
}

Colour Sampler::shade(int index, const Spot& spot) {
    const Shader& shader = picture_.shaders[std::size_t(index)];
    const Point p = spot.centre;
    if (const auto* solid = std::get_if<SolidShader>(&shader))
        return solid->colour;
    const auto* image = std::get_if<ImageShader>(&shader);
    const bool ofAPixel = image && image->isOfAPixel() && !ofTile_;
    const bool smooth = ofAPixel || std::holds_alternative<LinearShader>(shader) ||
                        std::holds_alternative<RadialShader>(shader);
    variation_ = std::max(variation_, smooth ? Variation::Smooth : Variation::Rough);
    if (const auto* tile = std::get_if<TileShader>(&shader))
        return tileColour(index, *tile, p);
    if (const auto* linear = std::get_if<LinearShader>(&shader))
        return linear->over(spot);
    if (const auto* radial = std::get_if<RadialShader>(&shader))
        return radial->over(spot);
    if (const auto* material = std::get_if<MaterialShader>(&shader))
        return material->at(p);
    return image->at(ofAPixel ? Point(std::floor(p.x) + 0.5, std::floor(p.y) + 0.5) : p);
}

Colour Sampler::tileColour(int shader, const TileShader& tile, Point p) {
    std::unique_ptr<Sampler>& sampler = tiles_[std::size_t(shader)];
    if (!sampler) {
        sampler = std::make_unique<Sampler>(*tile.tile);
        sampler->ofTile_ = true;
        sampler->indexRows();
    }
    return sampler->locate(tile.wrapped(p));
}

void Sampler::indexRows() {
    const std::size_t edges = picture_.edges.size();
    const std::size_t rows =
        std::clamp<std::size_t>(maxRowEntries / (edges + 1), 1, std::size_t(picture_.height));
    rowsPerPixel_ = double(rows) / picture_.height;
    const auto rowOf = [&](double y) {
        return std::size_t(std::clamp(y * rowsPerPixel_, 0.0, double(rows - 1)));
    };
    rowBegins_.assign(rows + 2, 0);
    const auto eachRow = [&](const auto& act) {
        for (std::size_t i = 0; i < edges; ++i)
            for (std::size_t r = rowOf(picture_.edges[i].y0); r <= rowOf(picture_.edges[i].y1); ++r)
                act(r, int(i));
    };
    eachRow([&](std::size_t r, int) { ++rowBegins_[r + 2]; });
    std::partial_sum(rowBegins_.begin(), rowBegins_.end(), rowBegins_.begin());
    rowEdges_.resize(rowBegins_.back());
    eachRow([&](std::size_t r, int i) { rowEdges_[rowBegins_[r + 1]++] = i; });
}

/// The colour at a point inside the tile: steps over all edges to its left, and back.
Colour Sampler::locate(Point p) {
    const auto row = std::size_t(p.y * rowsPerPixel_);
    crossed_.clear();
    for (std::size_t i = rowBegins_[row]; i < rowBegins_[row + 1]; ++i) {
        const Edge& edge = picture_.edges[std::size_t(rowEdges_[i])];
        if (edge.y0 <= p.y && p.y < edge.y1 && edge.xAt(p.y) <= p.x)
            crossed_.push_back(&edge);
    }
    for (const Edge* edge : crossed_)
        cross(edge->shape, edge->winding);
    const Colour colour = colourOver({p});
    for (const Edge* edge : crossed_)
        cross(edge->shape, -edge->winding);
    return colour;
}

}  // namespace vtm::reference

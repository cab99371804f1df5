#include <unordered_map>

#include "conformance/reference/coverage/coverage.hpp"
#include "conformance/reference/coverage/rows.hpp"
#include "conformance/reference/paint/composite.hpp"

namespace vtm::reference {
namespace {

/// Points a side of a pixel at which patterns and gradients are read; other paints at its centre only.
constexpr int patternSamples = 8, gradientSamples = 16;

int samplesOf(const Shader& shader) {
    if (std::holds_alternative<TileShader>(shader))
        return patternSamples;
    const bool isGradient =
        std::holds_alternative<LinearShader>(shader) || std::holds_alternative<RadialShader>(shader);
    return isGradient ? gradientSamples : 1;
}

using Coverage = std::vector<double>;

/// The coverages of a row by the shapes that meet it.
class RowCoverages {
public:
    RowCoverages(const FlatScene& picture, RowSweep& sweep, std::span<const EdgePart> parts, int y) {
        layers_.resize(picture.trees.size());
        for (std::size_t begin = 0; begin < parts.size();) {
            const int index = parts[begin].shape;
            std::size_t end = begin;
            while (end < parts.size() && parts[end].shape == index)
                ++end;
            const Shape& shape = picture.shapes[std::size_t(index)];
            Coverage& row = rows_[index];
            row.assign(std::size_t(picture.width), 0);
            CoverageRow sum(shape.rule, row.data());
            sweep.sweep(parts.subspan(begin, end - begin), y, sum);
            if (!shape.ofClip)
                layers_[std::size_t(shape.owner)].push_back(shape.place);
            begin = end;
        }
        for (std::vector<int>& places : layers_)
            std::sort(places.begin(), places.end());
    }

    /// Null where the shape does not meet the row.
    const Coverage* of(int shape) const {
        const auto found = rows_.find(shape);
        return found == rows_.end() ? nullptr : &found->second;
    }
    const std::vector<int>& layers(int tree) const { return layers_[std::size_t(tree)]; }

private:
    std::unordered_map<int, Coverage> rows_;
    std::vector<std::vector<int>> layers_;
};

/// Composites a row: groups are rows of colours.
struct RowCanvas {
    const FlatScene& picture;
    const RowCoverages& coverages;
    Sampler& sampler;
    int y;
    std::vector<std::vector<Colour>> stack = {};

    void open(const GroupNode&) { stack.emplace_back(std::size_t(picture.width), Colour(0)); }

    void draw(const Layer& layer) {
        const Coverage& coverage = *coverages.of(layer.shape);
        std::vector<Colour>& row = stack.back();
        for (std::size_t x = 0; x < row.size(); ++x)
            if (coverage[x] > 0)
                row[x] = over(row[x], paint(layer.shader, int(x)) * (layer.opacity * coverage[x]));
    }

    void close(const GroupNode& group) {
        std::vector<Colour> row = std::move(stack.back());
        stack.pop_back();
        const Coverage share = shareOf(group);
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] *= share[x];
        if (group.parent == noIndex) {
            stack.push_back(std::move(row));
            return;
        }
        for (std::size_t x = 0; x < row.size(); ++x)
            stack.back()[x] = blend(group.blend, stack.back()[x], row[x]);
    }

    Colour paint(int shader, int x) {
        const int n = samplesOf(picture.shaders[std::size_t(shader)]);
        Colour sum(0);
        for (int i = 0; i < n * n; ++i)
            sum += sampler.shade(shader, {{x + (i % n + 0.5) / n, y + (i / n + 0.5) / n}, Vector(1.0 / n)});
        return sum / double(n * n);
    }

    /// Opacity, clip and mask together.
    Coverage shareOf(const GroupNode& group) {
        Coverage share(std::size_t(picture.width), group.opacity);
        if (group.clip != noIndex)
            multiply(share, group.outside ? complement(clipShare(group.clip)) : clipShare(group.clip));
        if (group.mask != noIndex)
            multiply(share, maskShare(group.mask));
        return share;
    }

    static void multiply(Coverage& share, const Coverage& by) {
        for (std::size_t x = 0; x < share.size(); ++x)
            share[x] *= by[x];
    }

    static Coverage complement(Coverage share) {
        for (double& part : share)
            part = 1 - part;
        return share;
    }

    /// Shapes are laid over each other like layers.
    Coverage clipShare(int index) {
        const ClipNode& clip = picture.clips[std::size_t(index)];
        Coverage share(std::size_t(picture.width), 0);
        for (const ClipNode::Part& part : clip.parts) {
            if (!coverages.of(part.shape))
                continue;
            Coverage shape = *coverages.of(part.shape);
            if (part.clip != noIndex)
                multiply(shape, clipShare(part.clip));
            for (std::size_t x = 0; x < share.size(); ++x)
                share[x] += shape[x] * (1 - share[x]);
        }
        if (clip.clip != noIndex)
            multiply(share, clipShare(clip.clip));
        return share;
    }

    Coverage maskShare(int index) {
        const MaskNode& mask = picture.masks[std::size_t(index)];
        const std::vector<Colour> content = treeRow(mask.tree);
        Coverage share;
        for (const Colour& colour : content)
            share.push_back(mask.kind == scene::MaskKind::Alpha ? colour.a : luminance(colour, mask.linear));
        return share;
    }

    std::vector<Colour> treeRow(int tree) {
        composite(picture.trees[std::size_t(tree)], coverages.layers(tree), *this);
        std::vector<Colour> row = std::move(stack.back());
        stack.pop_back();
        return row;
    }
};

}  // namespace

CompatRows::CompatRows(const FlatScene& picture)
    : picture_(picture), sampler_(picture), sweep_(picture.width) {}

void CompatRows::render(std::span<const EdgePart> parts, int y, Colour* row) {
    const RowCoverages coverages(picture_, sweep_, parts, y);
    RowCanvas canvas{picture_, coverages, sampler_, y};
    const std::vector<Colour> colours = canvas.treeRow(0);
    std::copy(colours.begin(), colours.end(), row);
}

}  // namespace vtm::reference

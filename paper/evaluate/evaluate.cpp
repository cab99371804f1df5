// The recursion of the paper mode, rows 4, 5 and 14, as a loop: weights flow down the graph of nodes.

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "paper/evaluate.hpp"
#include "raster/src/paint.hpp"

namespace vtm::paper {

namespace {

using glm::dvec2;
using glm::vec4;

/// Nodes that still have a share of the pixel, smallest index first. A node has a larger index than
/// what its sides refer to; so the largest waiting one has all its weight, and is visited once.
class Pending {
public:
    explicit Pending(std::uint32_t root) { add(root, 1); }

    bool empty() const { return count_ == 0; }

    void add(std::uint32_t node, double weight) {
        unsigned at = count_;
        while (at > 0 && entries_[at - 1].node > node)
            --at;
        if (at > 0 && entries_[at - 1].node == node) {
            entries_[at - 1].weight += weight;
            return;
        }
        std::copy_backward(entries_.begin() + at, entries_.begin() + count_, entries_.begin() + count_ + 1);
        entries_[at] = {node, weight};
        ++count_;
    }

    struct Entry {
        std::uint32_t node;
        double weight;
    };
    Entry take() { return entries_[--count_]; }

private:
    std::array<Entry, maxPending> entries_{};
    unsigned count_ = 0;
};

class Fragment {
public:
    Fragment(const Asset& asset, const asset::Paints& palette, dvec2 point, const Footprint& pixel,
             bool repeats = false)
        : asset_(asset), palette_(palette), point_(point), pixel_(pixel), repeats_(repeats) {}

    Sample run() {
        if (asset_.root == noIndex)
            return sample_;
        Pending pending(asset_.root);
        while (!pending.empty())
            visit(pending.take(), pending);
        sample_.color = vec4(sum_);
        sample_.discarded = discards_ && !shows_;
        return sample_;
    }

private:
    void visit(const Pending::Entry& entry, Pending& pending) {
        const Node& node = asset_.nodes[entry.node];
        ++sample_.cost.nodes;
        double b = node.bounds ? (isNear(*node.bounds) ? 1.0 : 0.0) : double(node.opacity);
        if (b > 0 && node.mask != noIndex)
            b *= coverage(asset_.masks[node.mask]);
        show(node.inside, entry.weight * b, pending);
        show(node.outside, entry.weight * (1 - b), pending);
    }

    double coverage(const Mask& mask) {
        return repeats_ ? repeatedCoverage(mask, {asset_.width, asset_.height}, point_, pixel_, sample_.cost)
                        : maskCoverage(mask, point_, pixel_, sample_.cost);
    }

    /// Masks cover nothing of pixels that are further from their squares (isFar in mask.cpp).
    bool isNear(const Bounds& bounds) const {
        const dvec2 unit = dvec2(asset_.width, asset_.height) / 65535.0;
        const dvec2 reach(2 * pixel_.longer);
        const dvec2 min = unit * dvec2(bounds.min[0], bounds.min[1]) - reach,
                    max = unit * dvec2(bounds.max[0], bounds.max[1]) + reach;
        return point_.x > min.x && point_.y > min.y && point_.x < max.x && point_.y < max.y;
    }

    /// Row 4: a side without weight is not evaluated.
    void show(const Side& side, double weight, Pending& pending) {
        if (weight <= 0)
            return;
        if (side.discard) {
            discards_ = true;
            return;
        }
        double through = 1;
        if (side.paint != 0) {
            ++sample_.cost.paints;
            const glm::dvec4 color(
                palette_.color(side.paint, {glm::vec2(point_), glm::mat2(glm::inverse(pixel_.toPixels))}));
            sum_ += weight * color;
            through = 1 - color.a;
        }
        shows_ = true;
        if (side.rest != noIndex && through > 0)
            pending.add(side.rest, weight * through);
    }

    const Asset& asset_;
    const asset::Paints& palette_;
    const dvec2 point_;
    const Footprint& pixel_;
    const bool repeats_;
    glm::dvec4 sum_{0};
    bool discards_ = false, shows_ = false;
    Sample sample_;
};

/// Of the picture's rectangle, by the estimator of row 6.
double frameCoverage(const Asset& asset, dvec2 point, const Footprint& pixel) {
    const glm::dmat2 normals = glm::transpose(glm::inverse(pixel.toPixels));
    const dvec2 inside = glm::min(point, dvec2(asset.width, asset.height) - point);
    const double distance = std::min(inside.x / glm::length(normals[0]), inside.y / glm::length(normals[1]));
    return std::clamp(0.5 + distance, 0.0, 1.0);
}

}  // namespace

Cost& Cost::operator+=(const Cost& o) {
    nodes += o.nodes, masks += o.masks, indirections += o.indirections;
    cells += o.cells, mips += o.mips, paints += o.paints;
    return *this;
}

Sample sample(const Asset& asset, dvec2 point, const Footprint& pixel) {
    return Fragment(asset, asset::Paints(asset.palette), point, pixel).run();
}

Sample sampleRepeated(const Asset& asset, dvec2 point, const Footprint& pixel) {
    return Fragment(asset, asset::Paints(asset.palette), point, pixel, true).run();
}

image::Raster evaluate(const Asset& asset, const asset::View& view, Cost* cost) {
    asset::validate(view);
    image::Raster raster(view.width, view.height);
    const glm::dmat2 linear(view.toPixels[0], view.toPixels[1]);
    if (glm::determinant(linear) == 0)
        return raster;
    const glm::dmat2 inverse = glm::inverse(linear);
    const Footprint pixel(linear);
    const asset::Paints palette(asset.palette);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const dvec2 point = inverse * (dvec2(x + 0.5, y + 0.5) - view.toPixels[2]);
            const double frame = frameCoverage(asset, point, pixel);
            if (frame == 0)
                continue;
            const Sample s = Fragment(asset, palette, point, pixel).run();
            for (int c = 0; c < 4; ++c)
                raster.pixel(x, y)[c] = std::clamp(float(frame) * s.color[c], 0.0f, 1.0f);
            if (cost != nullptr)
                *cost += s.cost;
        }
    return raster;
}

}  // namespace vtm::paper

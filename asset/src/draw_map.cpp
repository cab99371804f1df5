#include "asset/src/draw_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "asset/coverage.hpp"
#include "asset/src/paint.hpp"
#include "asset/walk.hpp"

namespace vtm::asset {

namespace {

using glm::dvec2;
using glm::vec2;
using glm::vec4;

/// One leaf under one view. Doubles place it; floats, relative to the pixel, do the rest.
struct PlacedLeaf {
    glm::dmat2 linear;  ///< leaf steps to pixels
    dvec2 origin;       ///< of the leaf, pixels
    glm::mat2 inverse;  ///< pixels to leaf steps
    float sign;         ///< of the determinant; 0 where the view flattens the plane
    dvec2 corner;       ///< of the leaf, picture coordinates
    double step;        ///< a leaf step in picture units
};

PlacedLeaf place(const View& view, dvec2 corner, double side) {
    const double step = side / leafExtent;
    const glm::dmat2 linear(view.toPixels[0] * step, view.toPixels[1] * step);
    const double determinant = glm::determinant(linear);
    const bool flat = !(std::abs(determinant) > std::numeric_limits<double>::min());
    return {linear,
            view.toPixels * glm::dvec3(corner, 1),
            flat ? glm::mat2(0) : glm::mat2(glm::inverse(linear)),
            flat              ? 0.0f
            : determinant > 0 ? 1.0f
                              : -1.0f,
            corner,
            step};
}

/// The part of the leaf that the bounding box (in leaf coordinates) of the pixel's box meets.
struct Overlap {
    vec2 min, max;
    bool empty() const { return min.x >= max.x || min.y >= max.y; }
};

/// The pixel's centre in leaf coordinates.
vec2 centreIn(const PlacedLeaf& leaf, const LeafFrame& frame) {
    return leaf.inverse * (vec2(0.5f) - frame.origin);
}

Overlap overlapOf(const PlacedLeaf& leaf, const LeafFrame& frame) {
    const vec2 centre = centreIn(leaf, frame);
    const vec2 half = (glm::abs(leaf.inverse[0]) + glm::abs(leaf.inverse[1])) * 0.5f;
    return {glm::max(centre - half, vec2(0)), glm::min(centre + half, vec2(leafExtent))};
}

/// Σ colour · weight, evaluating a paint only when it is not one of the last two: the two sides of
/// a chain of pieces.
class ColorSum {
public:
    ColorSum(const Paints& paints, PaintMeaning meaning, const MaterialFunction& materials,
             const PaintPlace& place)
        : paints_(paints), meaning_(meaning), materials_(materials), place_(place) {}

    void add(std::uint32_t paint, float weight) {
        if (weight != 0)
            sum_ += weight * color(paint);
    }
    vec4 sum() const { return sum_; }

private:
    struct Known {
        std::uint32_t paint = std::numeric_limits<std::uint32_t>::max();
        vec4 color{0};
    };

    vec4 color(std::uint32_t paint) {
        if (meaning_ == PaintMeaning::Coverage)
            return vec4(float(paint));
        if (recent_.paint != paint) {
            std::swap(recent_, older_);
            if (recent_.paint != paint)
                recent_ = {paint, paints_.color(paint, place_, materials_)};
        }
        return recent_.color;
    }

    const Paints& paints_;
    PaintMeaning meaning_;
    const MaterialFunction& materials_;
    PaintPlace place_;
    Known recent_, older_;
    vec4 sum_{0};
};

vec4 leafIntegral(const AssetView& asset, Entry entry, const PlacedLeaf& placed, const LeafFrame& frame,
                  ColorSum sum) {
    const Corners corners = cornersOf(frame);
    if (entry.kind() == Entry::Kind::Solid) {
        float area = 0;
        for (std::size_t k = 0; k < 4; ++k)
            area += seg(corners[k], corners[k + 1]);
        sum.add(entry.payload(), area);
        return placed.sign * sum.sum();
    }
    const Leaf& leaf = asset.leaves[entry.payload()];
    for (std::size_t k = 0; k < 4; ++k)
        sum.add(leaf.corners[k], seg(corners[k], corners[k + 1]));
    for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
        const Piece& piece = asset.pieces[leaf.firstPiece + i];
        const float weight = pieceSum(frame, corners, piece);
        sum.add(piece.left, weight);
        sum.add(piece.right, -weight);
    }
    return placed.sign * sum.sum();
}

void addLeaf(const Paints& paints, PaintMeaning meaning, const MaterialFunction& materials, Entry entry,
             const PlacedLeaf& placed, const PixelBox& box, image::Raster& target) {
    const glm::mat2 footprint = placed.inverse * float(placed.step);
    for (int y = box.min.y; y < box.max.y; ++y)
        for (int x = box.min.x; x < box.max.x; ++x) {
            const LeafFrame frame{glm::mat2(placed.linear), vec2(placed.origin - dvec2(x, y))};
            if (overlapOf(placed, frame).empty())
                continue;
            const vec2 samplePoint(placed.corner + placed.step * dvec2(centreIn(placed, frame)));
            const vec4 color = leafIntegral(paints.asset(), entry, placed, frame,
                                            {paints, meaning, materials, {samplePoint, footprint}});
            float* pixel = target.pixel(x, y);
            for (int c = 0; c < 4; ++c)
                pixel[c] += color[c];
        }
}

bool isTransparent(PaintMeaning meaning, const AssetView& asset, Entry entry) {
    if (entry.kind() != Entry::Kind::Solid)
        return false;
    return meaning == PaintMeaning::Coverage ? entry.payload() == 0
                                             : asset.paints[entry.payload()] == Paint{};
}

}  // namespace

PixelBox pixelsOf(const View& view, dvec2 corner, double side) {
    const dvec2 origin = view.toPixels * glm::dvec3(corner, 1);
    const dvec2 x = view.toPixels[0] * side, y = view.toPixels[1] * side, zero(0);
    const dvec2 size(view.width, view.height);
    const dvec2 min = origin + glm::min(x, zero) + glm::min(y, zero);
    const dvec2 max = origin + glm::max(x, zero) + glm::max(y, zero);
    return {glm::ivec2(glm::clamp(glm::floor(min), zero, size)),
            glm::ivec2(glm::clamp(glm::ceil(max), zero, size))};
}

View crop(const View& view, const PixelBox& box) {
    View cropped = view;
    cropped.width = std::max(0, box.max.x - box.min.x);
    cropped.height = std::max(0, box.max.y - box.min.y);
    cropped.toPixels[2] -= dvec2(box.min);
    return cropped;
}

void addMap(const Paints& paints, const Map& map, const View& view, PaintMeaning meaning,
            const MaterialFunction& materials, image::Raster& target) {
    const AssetView& asset = paints.asset();
    walk(asset, map.root, [&](Cell cell, Entry entry) {
        if (isTransparent(meaning, asset, entry))
            return;
        const double side = std::ldexp(map.side, -2 * int(cell.level));
        const dvec2 corner(map.x + cell.x * side, map.y + cell.y * side);
        const PixelBox box = pixelsOf(view, corner, side);
        if (!box.empty())
            addLeaf(paints, meaning, materials, entry, place(view, corner, side), box, target);
    });
}

}  // namespace vtm::asset

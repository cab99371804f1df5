#include "raster/src/draw_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <vtm/limits/limits.hpp>
#include "asset/instances.hpp"
#include "asset/walk.hpp"
#include "raster/coverage.hpp"
#include "raster/src/paint.hpp"
#include "raster/src/rough.hpp"
#include "raster/src/row_sums.hpp"
#include "raster/steepness.hpp"

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
    Affine2 toPicture;  ///< leaf steps to the picture
};

/// `toPicture`: from the leaf's square, [0, 1]².
PlacedLeaf place(const View& view, const Affine2& toPicture) {
    const glm::dmat2 steps = toPicture.linear * (1.0 / leafExtent);
    const glm::dmat2 linear = glm::dmat2(view.toPixels[0], view.toPixels[1]) * steps;
    const double determinant = glm::determinant(linear);
    const bool flat = !(std::abs(determinant) > std::numeric_limits<double>::min());
    return {linear,
            view.toPixels * glm::dvec3(toPicture.offset, 1),
            flat ? glm::mat2(0) : glm::mat2(glm::inverse(linear)),
            flat              ? 0.0f
            : determinant > 0 ? 1.0f
                              : -1.0f,
            {steps, toPicture.offset}};
}

/// The part of the leaf that the bounding box (in leaf coordinates) of the pixel's box meets.
struct Overlap {
    vec2 min, max;
    bool whole;  ///< the pixel lies inside the leaf
    bool empty() const { return min.x >= max.x || min.y >= max.y; }
};

/// A point of the pixel in leaf coordinates.
vec2 pointIn(const PlacedLeaf& leaf, const LeafFrame& frame, vec2 point) {
    return leaf.inverse * (point - frame.origin);
}

Overlap overlapOf(const PlacedLeaf& leaf, const LeafFrame& frame) {
    const vec2 centre = pointIn(leaf, frame, vec2(0.5f));
    const vec2 half = (glm::abs(leaf.inverse[0]) + glm::abs(leaf.inverse[1])) * 0.5f;
    const vec2 min = centre - half, max = centre + half;
    return {glm::max(min, vec2(0)), glm::min(max, vec2(leafExtent)),
            min.x >= 0 && min.y >= 0 && max.x <= leafExtent && max.y <= leafExtent};
}

PaintPlace placeOf(const PlacedLeaf& leaf, const LeafFrame& frame, vec2 point, float size) {
    return {vec2(leaf.toPicture(dvec2(pointIn(leaf, frame, point)))),
            glm::mat2(leaf.toPicture.linear) * leaf.inverse * size};
}

/// What a paint index of a map stands for.
enum class PaintMeaning {
    Color,    ///< Asset::paints
    Coverage  ///< the index itself, 0 or 1
};

/// What is drawn under one view.
struct Drawn {
    const Paints& paints;
    PaintMeaning meaning;
    const MaterialFunction& materials;
    float minSteep;
    RoughBounds rough;
    bool findsRough;                       ///< whether rough pixels are looked for
    const PlacedPaints* placed = nullptr;  ///< of a map that is placed in another

    std::uint32_t paintOf(std::uint32_t number) const { return placed ? (*placed)(number) : number; }
    const AssetView& asset() const { return paints.asset(); }
    bool isSteep(std::uint32_t paint) const {
        return meaning == PaintMeaning::Color && paints.changes()[paint].steepness > minSteep;
    }
    bool mayBeRough(std::uint32_t paint) const { return rough.mayBeRough(paints.changes()[paint]); }
    /// Those of a square.
    std::vector<std::uint32_t> steepPaints(Entry entry) const {
        std::vector<std::uint32_t> steep;
        const auto add = [&](std::uint32_t paint) {
            if (isSteep(paint) && std::ranges::find(steep, paint) == steep.end())
                steep.push_back(paint);
        };
        if (placed)
            add(placed->ground());
        if (entry.kind() == Entry::Kind::Solid) {
            add(paintOf(entry.payload()));
            return steep;
        }
        const Leaf& leaf = asset().leaves[entry.payload()];
        for (const std::uint16_t corner : leaf.corners)
            add(paintOf(corner));
        for (const Piece& piece : asset().pieces.subspan(leaf.firstPiece, leaf.pieceCount)) {
            add(paintOf(piece.left));
            add(paintOf(piece.right));
        }
        return steep;
    }
};

/// Σ colour · weight, evaluating a paint only when it is not one of the last two: the two sides of
/// a chain of pieces.
class ColorSum {
public:
    ColorSum(const Drawn& drawn, const PaintPlace& place, bool steepOnly = false)
        : drawn_(drawn), place_(place), steepOnly_(steepOnly) {}

    void add(std::uint32_t paint, float weight) {
        if (weight != 0 && (!steepOnly_ || drawn_.isSteep(paint)))
            sum_ += weight * color(paint);
    }
    vec4 sum() const { return sum_; }

private:
    struct Known {
        std::uint32_t paint = std::numeric_limits<std::uint32_t>::max();
        vec4 color{0};
    };

    vec4 color(std::uint32_t paint) {
        if (drawn_.meaning == PaintMeaning::Coverage)
            return vec4(float(paint));
        if (recent_.paint != paint) {
            std::swap(recent_, older_);
            if (recent_.paint != paint)
                recent_ = {paint, drawn_.paints.color(paint, place_, drawn_.materials)};
        }
        return recent_.color;
    }

    const Drawn& drawn_;
    PaintPlace place_;
    bool steepOnly_;
    Known recent_, older_;
    vec4 sum_{0};
};

/// Calls addPaint(paint, weight) for everything that adds up to the pixel's shares of a square's paints; of a
/// placed map each takes the place of its ground.
template <class Add>
void addShares(const Drawn& drawn, Entry entry, const LeafFrame& frame, Add&& addPaint) {
    const AssetView& asset = drawn.asset();
    const Corners corners = cornersOf(frame);
    const auto add = [&](std::uint32_t number, float weight) {
        const std::uint32_t paint = drawn.paintOf(number);
        if (drawn.placed && paint == drawn.placed->ground())
            return;
        addPaint(paint, weight);
        if (drawn.placed)
            addPaint(drawn.placed->ground(), -weight);
    };
    if (entry.kind() == Entry::Kind::Solid) {
        float area = 0;
        for (std::size_t k = 0; k < 4; ++k)
            area += seg(corners[k], corners[k + 1]);
        return add(entry.payload(), area);
    }
    const Leaf& leaf = asset.leaves[entry.payload()];
    for (std::size_t k = 0; k < 4; ++k)
        add(leaf.corners[k], seg(corners[k], corners[k + 1]));
    for (std::uint32_t i = 0; i < leaf.pieceCount; ++i) {
        const Piece& piece = asset.pieces[leaf.firstPiece + i];
        const float weight = pieceSum(frame, corners, piece);
        add(piece.left, weight);
        add(piece.right, -weight);
    }
}

vec4 leafIntegral(const Drawn& drawn, Entry entry, const PlacedLeaf& placed, const LeafFrame& frame,
                  ColorSum sum) {
    addShares(drawn, entry, frame, [&](std::uint32_t paint, float weight) { sum.add(paint, weight); });
    return placed.sign * sum.sum();
}

// ---- Quarters -------------------------------------------------------------------------------------

/// Whether a piece may meet the pixel's box: the box around its ends grown by how far it is from its chord.
bool mayMeetPixel(const LeafFrame& frame, const Piece& piece) {
    const vec2 a = frame(vec2(piece.a[0], piece.a[1])), b = frame(vec2(piece.b[0], piece.b[1]));
    const float bulge = 4.0f / 27 / slopeScale * float(std::abs(piece.slopeA) + std::abs(piece.slopeB));
    const vec2 along = vec2(piece.b[0], piece.b[1]) - vec2(piece.a[0], piece.a[1]);
    const vec2 margin = bulge * glm::abs(frame.linear * vec2(-along.y, along.x));
    const vec2 min = glm::min(a, b) - margin, max = glm::max(a, b) + margin;
    return min.x <= 1 && min.y <= 1 && max.x >= 0 && max.y >= 0;
}

bool isCut(const AssetView& asset, Entry entry, const Overlap& overlap, const LeafFrame& frame) {
    if (!overlap.whole)
        return true;
    if (entry.kind() == Entry::Kind::Solid)
        return false;
    const Leaf& leaf = asset.leaves[entry.payload()];
    return std::ranges::any_of(asset.pieces.subspan(leaf.firstPiece, leaf.pieceCount),
                               [&](const Piece& piece) { return mayMeetPixel(frame, piece); });
}

constexpr std::array<vec2, 4> pixelCorners{vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)};

/// What it means that steep paints are not the same in the quarters of a pixel, of which regions have other
/// shares than of the whole: the sum over the quarters of (its share - the whole's) times its colour.
vec4 quartersOf(const Drawn& drawn, Entry entry, const PlacedLeaf& placed, const LeafFrame& frame) {
    vec4 sum(0);
    for (const vec2 corner : pixelCorners) {
        const LeafFrame quarter{2.0f * frame.linear, 2.0f * frame.origin - corner};
        const PaintPlace place = placeOf(placed, frame, 0.25f + 0.5f * corner, 0.5f);
        sum += leafIntegral(drawn, entry, placed, quarter, {drawn, place, true}) -
               leafIntegral(drawn, entry, placed, frame, {drawn, place, true});
    }
    return 0.25f * sum;
}

/// Whether a pixel with a part of this steep paint wants to be drawn finer.
bool isRough(const Drawn& drawn, std::uint32_t paint, bool isCut, const PlacedLeaf& placed,
             const LeafFrame& frame) {
    const PaintPlace pixel = placeOf(placed, frame, vec2(0.5f), 1);
    const PaintChange change = drawn.paints.changeNear(
        paint, {dvec2(pixel.point), 0, std::numbers::sqrt2 * double(drawn.rough.pixel)});
    const auto colorAt = [&](vec2 point, float size) {
        return float4(drawn.paints.color(paint, placeOf(placed, frame, point, size), drawn.materials));
    };
    const std::array<Float4, 4> quarters{colorAt({0.25f, 0.25f}, 0.5f), colorAt({0.75f, 0.25f}, 0.5f),
                                         colorAt({0.25f, 0.75f}, 0.5f), colorAt({0.75f, 0.75f}, 0.5f)};
    if (isCut && drawn.rough.isRoughCut(change, quarters))
        return true;
    if (!drawn.rough.mayBeRoughNear(change))
        return false;
    const Float4 color = colorAt(vec2(0.5f), 1);
    if (drawn.rough.isRoughWhole(change, quarters, color))
        return true;
    return change.mayJump && std::ranges::any_of(pixelCorners, [&](vec2 corner) {
               return drawn.rough.isRoughCorner(colorAt(corner, 0), color);
           });
}

/// Whether a pixel wants to be drawn finer for any of a square's steep paints.
bool isRough(const Drawn& drawn, Entry entry, std::span<const std::uint32_t> steep, bool isCut,
             const PlacedLeaf& placed, const LeafFrame& frame) {
    const auto mayBe = [&](std::uint32_t paint) { return isCut || drawn.mayBeRough(paint); };
    if (std::ranges::none_of(steep, mayBe))
        return false;
    std::vector<float> shares(steep.size());
    addShares(drawn, entry, frame, [&](std::uint32_t paint, float weight) {
        if (const auto at = std::ranges::find(steep, paint); at != steep.end())
            shares[std::size_t(at - steep.begin())] += weight;
    });
    for (std::size_t i = 0; i < steep.size(); ++i)
        if (std::abs(shares[i]) > minShare && mayBe(steep[i]) &&
            isRough(drawn, steep[i], isCut, placed, frame))
            return true;
    return false;
}

/// Pixels of a raster that want to be drawn finer.
class RoughPixels {
public:
    explicit RoughPixels(const View& view)
        : width_(view.width), height_(view.height), isRough_(std::size_t(width_) * std::size_t(height_)) {}

    void mark(int x, int y) { isRough_[index(x, y)] = true; }
    bool at(int x, int y) const { return isRough_[index(x, y)]; }
    /// Calls visit(box) for boxes around all of them, none larger than a tile, disjoint.
    template <class Visit>
    void forEachBox(Visit&& visit) const {
        for (int y = 0; y < height_; y += tile)
            for (int x = 0; x < width_; x += tile)
                if (const PixelBox box = boxIn(x, y); !box.empty())
                    visit(box);
    }

private:
    static constexpr int tile = 32;

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }
    PixelBox boxIn(int left, int top) const {
        PixelBox box{glm::ivec2(left + tile, top + tile), glm::ivec2(left, top)};
        for (int y = top; y < std::min(top + tile, height_); ++y)
            for (int x = left; x < std::min(left + tile, width_); ++x)
                if (at(x, y)) {
                    box.min = glm::min(box.min, glm::ivec2(x, y));
                    box.max = glm::max(box.max, glm::ivec2(x + 1, y + 1));
                }
        return box;
    }

    int width_, height_;
    std::vector<bool> isRough_;
};

void addLeaf(const Drawn& drawn, Entry entry, const PlacedLeaf& placed, const PixelBox& box,
             image::Raster& target, RoughPixels& rough) {
    const std::vector<std::uint32_t> steep = drawn.steepPaints(entry);
    for (int y = box.min.y; y < box.max.y; ++y)
        for (int x = box.min.x; x < box.max.x; ++x) {
            limits::check();
            const LeafFrame frame{glm::mat2(placed.linear), vec2(placed.origin - dvec2(x, y))};
            const Overlap overlap = overlapOf(placed, frame);
            if (overlap.empty())
                continue;
            const PaintPlace place = placeOf(placed, frame, vec2(0.5f), 1);
            vec4 color = leafIntegral(drawn, entry, placed, frame, {drawn, place});
            const bool cut = !steep.empty() && isCut(drawn.asset(), entry, overlap, frame);
            if (cut)
                color += quartersOf(drawn, entry, placed, frame);
            if (drawn.findsRough && !steep.empty() && !rough.at(x, y) &&
                isRough(drawn, entry, steep, cut, placed, frame))
                rough.mark(x, y);
            float* pixel = target.pixel(x, y);
            for (int c = 0; c < 4; ++c)
                pixel[c] += color[c];
        }
}

/// Whether a square changes nothing.
bool isTransparent(const Drawn& drawn, Entry entry) {
    if (entry.kind() != Entry::Kind::Solid)
        return false;
    const std::uint32_t paint = drawn.paintOf(entry.payload());
    if (drawn.placed)
        return paint == drawn.placed->ground();
    return drawn.meaning == PaintMeaning::Coverage ? paint == 0 : drawn.asset().paints[paint] == Paint{};
}

}  // namespace

PixelBox pixelsOf(const View& view, const Affine2& toPicture) {
    const glm::dmat2 toPixels(view.toPixels[0], view.toPixels[1]);
    const dvec2 origin = view.toPixels * glm::dvec3(toPicture.offset, 1);
    const dvec2 x = toPixels * toPicture.linear[0], y = toPixels * toPicture.linear[1], zero(0);
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

namespace {

/// `toPicture`: from the map's square, [0, 1]².
void addSquares(const Drawn& drawn, const Map& map, const Affine2& toPicture, const View& view,
                image::Raster& target, RoughPixels& rough) {
    walk(drawn.asset(), map.root, [&](Cell cell, Entry entry) {
        if (isTransparent(drawn, entry))
            return;
        const double side = std::ldexp(1.0, -2 * int(cell.level));
        const Affine2 square = compose(toPicture, {glm::dmat2(side), dvec2(cell.x, cell.y) * side});
        const PixelBox box = pixelsOf(view, square);
        if (!box.empty())
            addLeaf(drawn, entry, place(view, square), box, target, rough);
    });
}

/// Returns the pixels that want to be drawn finer.
RoughPixels addMap(const Drawn& drawn, const Map& map, const View& view, image::Raster& target) {
    RoughPixels rough(view);
    addSquares(drawn, map, placeOf(map), view, target, rough);
    if (map.instances != 0)
        forEachMap(drawn.asset(), map, [&](const PlacedMap& placed) {
            if (&placed.map == &map)
                return true;
            if (pixelsOf(view, placed.toPicture).empty())
                return false;
            Drawn inner = drawn;
            inner.placed = &placed.paints;
            addSquares(inner, placed.map, placed.toPicture, view, target, rough);
            return true;
        });
    return rough;
}

View finerView(const View& view, const PixelBox& box) {
    View finer = crop(view, box);
    finer.width *= finerSide;
    finer.height *= finerSide;
    for (int i = 0; i < 3; ++i)
        finer.toPixels[i] *= double(finerSide);
    return finer;
}

vec4 meanOfFiner(const image::Raster& finer, int x, int y) {
    vec4 sum(0);
    for (int row = 0; row < finerSide; ++row)
        for (int column = 0; column < finerSide; ++column)
            sum += glm::make_vec4(finer.pixel(x * finerSide + column, y * finerSide + row));
    return sum / float(finerSide * finerSide);
}

/// `levels`: how many times over rough pixels are drawn finer. `colors` is transparent.
void drawColors(const Paints& paints, const Map& map, const View& view, const MaterialFunction& materials,
                int levels, float roughness, image::Raster& colors) {
    const glm::dmat2 pixel = glm::inverse(glm::dmat2(view.toPixels[0], view.toPixels[1]));
    const float minSteep = minSteepness(pixel);
    const Drawn drawn{paints,    PaintMeaning::Color, materials, minSteep, roughBounds(minSteep, roughness),
                      levels > 0};
    const RoughPixels rough = addMap(drawn, map, view, colors);
    if (levels == 0)
        return;
    rough.forEachBox([&](const PixelBox& box) {
        const View fine = finerView(view, box);
        image::Raster finer(fine.width, fine.height);
        drawColors(paints, map, fine, materials, levels - 1, finerTolerance * roughness, finer);
        for (int y = box.min.y; y < box.max.y; ++y)
            for (int x = box.min.x; x < box.max.x; ++x)
                if (rough.at(x, y)) {
                    const vec4 mean = meanOfFiner(finer, x - box.min.x, y - box.min.y);
                    std::copy_n(glm::value_ptr(mean), 4, colors.pixel(x, y));
                }
    });
}

}  // namespace

void addCoverage(const Paints& paints, const Map& map, const View& view, image::Raster& target) {
    addMap({paints, PaintMeaning::Coverage, {}, 0, {}, false}, map, view, target);
}

void addColors(const Paints& paints, const Map& map, const View& view, const MaterialFunction& materials,
               int finerLevels, image::Raster& target) {
    image::Raster colors(view.width, view.height);
    drawColors(paints, map, view, materials, finerLevels, 1, colors);
    for (std::size_t i = 0; i < colors.rgba.size(); ++i)
        target.rgba[i] += colors.rgba[i];
}

}  // namespace vtm::asset

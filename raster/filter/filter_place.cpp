#include "raster/filter_place.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "raster/filter_tables.hpp"

namespace vtm::asset {

PixelBox PixelRect::pixels() const {
    constexpr double rounding = 1e-6;  // of sides that are meant to lie between pixels
    return {glm::ivec2(glm::floor(min + rounding)), glm::ivec2(glm::ceil(max - rounding))};
}

namespace {

/// Pixels that one layer of a filter may have; where more are needed, its raster is coarser.
constexpr double maxLayerPixels = 0x1p24;
/// Largest coordinate of a pixel.
constexpr double largestPixel = 0x1p28;

glm::dmat3x2 composed(const glm::dmat3x2& outer, const glm::dmat3x2& inner) {
    const glm::dmat2 linear(outer[0], outer[1]);
    return {linear * inner[0], linear * inner[1], linear * inner[2] + outer[2]};
}

glm::dmat3x2 inverted(const glm::dmat3x2& m) {
    const glm::dmat2 linear = glm::inverse(glm::dmat2(m[0], m[1]));
    return {linear[0], linear[1], -(linear * m[2])};
}

glm::dvec2 clampedPixel(glm::dvec2 p) { return glm::clamp(p, -largestPixel, largestPixel); }

/// Whole pixels round a box.
PixelBox outwards(glm::dvec2 min, glm::dvec2 max) {
    constexpr double rounding = 1e-9;  // of coordinates that are meant to be whole
    return {glm::ivec2(glm::floor(clampedPixel(min) + rounding)),
            glm::ivec2(glm::ceil(clampedPixel(max) - rounding))};
}

}  // namespace

PixelBox mapped(const PixelBox& box, const glm::dmat3x2& m) {
    if (box.empty())
        return {};
    glm::dvec2 min(HUGE_VAL), max(-HUGE_VAL);
    for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y);
        const glm::dvec2 q = m * glm::dvec3(p, 1);
        min = glm::min(min, q);
        max = glm::max(max, q);
    }
    return outwards(min, max);
}

namespace {

class Placement {
public:
    Placement(const AssetView& asset, const Filter& filter, const View& below, double coarser)
        : asset_(asset), filter_(filter) {
        place_.inWholePixels = asset.mode == Mode::Compat;
        const auto& m = filter.matrix;
        const glm::dmat3x2 toPicture(m[0], m[1], m[2], m[3], m[4], m[5]);
        const glm::dmat3x2 toPixels = composed(below.toPixels, toPicture);
        placeRaster(toPixels, coarser);
        place_.pictureToRaster = composed(
            {place_.scale.x, 0, 0, place_.scale.y, place_.origin.x, place_.origin.y}, inverted(toPicture));
        if (!isDrawable(place_.pictureToRaster) || !isDrawable(place_.toBelow)) {
            showNothing();
            return;
        }
        place_.region = rect(filter.region);
        for (const FilterPrimitive& primitive : primitivesOf(asset, filter)) {
            PixelRect own = rect(primitive.region);
            own.min = glm::max(own.min, place_.region.min);
            own.max = glm::max(own.min, glm::min(own.max, place_.region.max));
            place_.regions.push_back(own);
        }
        findNeeds(below);
    }

    FilterPlace take() { return std::move(place_); }
    /// How many times too large the largest layer's sides are.
    double excess(double maxSide) const {
        double largest = 0;
        const auto add = [&](const PixelBox& box) {
            largest = std::max({largest, std::sqrt(double(box.area()) / maxLayerPixels),
                                box.width() / maxSide, box.height() / maxSide});
        };
        add(place_.shown);
        std::ranges::for_each(place_.needed, add);
        std::ranges::for_each(place_.pictures, add);
        return largest;
    }

private:
    /// Whether pixels map to pixels: axes to axes, of length 1.
    static bool isGrid(const glm::dmat2& turn) {
        constexpr double rounding = 1e-7;
        const auto isUnit = [&](glm::dvec2 v) {
            v = glm::abs(v);
            return glm::length(v - glm::dvec2(1, 0)) < rounding ||
                   glm::length(v - glm::dvec2(0, 1)) < rounding;
        };
        return isUnit(turn[0]) && isUnit(turn[1]);
    }

    void placeRaster(const glm::dmat3x2& toPixels, double coarser) {
        const auto lengthOf = [](glm::dvec2 v) { return std::max(glm::length(v), 1e-12); };
        place_.scale = {lengthOf(toPixels[0]) / coarser, lengthOf(toPixels[1]) / coarser};
        glm::dmat2 turn(toPixels[0] / place_.scale.x, toPixels[1] / place_.scale.y);
        place_.isSampled = !isGrid(turn);
        if (place_.isSampled) {
            place_.toBelow = {turn[0], turn[1], toPixels[2]};
            return;
        }
        turn = {glm::round(turn[0]), glm::round(turn[1])};
        // The raster's origin falls on the corner of a pixel below.
        place_.toBelow = {turn[0], turn[1], glm::dvec2(0)};
        place_.origin = glm::transpose(turn) * toPixels[2];
        if (!(std::abs(place_.origin.x) < largestPixel && std::abs(place_.origin.y) < largestPixel)) {
            const glm::dvec2 whole = glm::floor(place_.origin);
            place_.origin -= whole;
            place_.toBelow[2] = turn * whole;
        }
    }

    PixelRect rect(const std::array<double, 4>& box) const {
        const PixelRect exact{clampedPixel(place_.scale * glm::dvec2(box[0], box[1]) + place_.origin),
                              clampedPixel(place_.scale * glm::dvec2(box[2], box[3]) + place_.origin)};
        if (!place_.inWholePixels)
            return exact;
        const PixelBox pixels = exact.pixels();
        return {pixels.min, pixels.max};
    }

    static bool isDrawable(const glm::dmat3x2& m) {
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(m[i].x) <= maxViewNumber && std::abs(m[i].y) <= maxViewNumber))
                return false;
        return std::abs(glm::determinant(glm::dmat2(m[0], m[1]))) > 0;
    }

    /// Where a matrix of the file or of the view is beyond all pictures.
    void showNothing() {
        place_ = {};
        place_.regions.assign(filter_.primitives, {});
        place_.needed.assign(filter_.primitives, {});
        place_.pictures.assign(filter_.pictures, {});
    }

    /// From the last primitive to the first.
    void findNeeds(const View& below) {
        PixelBox seen = mapped({{0, 0}, {below.width, below.height}}, inverted(place_.toBelow));
        if (place_.isSampled)
            seen = seen.grown({2, 2});
        const auto primitives = primitivesOf(asset_, filter_);
        place_.needed.assign(primitives.size(), {});
        place_.pictures.assign(filter_.pictures, {});
        place_.shown = seen.intersection(place_.region.pixels());
        place_.needed.back() = place_.shown.intersection(place_.regions.back().pixels());
        for (std::size_t i = primitives.size(); i-- > 0;) {
            const PixelBox box = place_.needed[i];
            if (box.empty())
                continue;
            const auto inputs = inputsOf(asset_, primitives[i]);
            for (std::size_t k = 0; k < inputs.size(); ++k)
                need(inputs[k], neededOf(primitives[i], k, box, regionOf(inputs[k])));
            if (primitives[i].op == FilterOp::Picture)
                add(place_.pictures[std::size_t(parametersOf(asset_, primitives[i])[0])], box);
        }
    }

    PixelBox regionOf(std::uint32_t input) const {
        return (input < firstResult ? place_.region : place_.regions[resultOf(input)]).pixels();
    }

    void need(std::uint32_t input, const PixelBox& box) {
        add(input < firstResult ? place_.pictures[0] : place_.needed[resultOf(input)],
            box.intersection(regionOf(input)));
    }
    static void add(PixelBox& to, const PixelBox& box) { to = to.joined(box); }

    /// What of input k a primitive reads for a box of its result. `whole`: all there is.
    PixelBox neededOf(const FilterPrimitive& primitive, std::size_t k, const PixelBox& box,
                      const PixelBox& whole) const {
        const FilterParameters p = parametersOf(asset_, primitive);
        const glm::dvec2 scale = place_.scale;
        switch (primitive.op) {
            case FilterOp::GaussianBlur:
                return box.grown(blur(p[0], p[1]));
            case FilterOp::DropShadow:
                return box.joined(movedBack(box, p[0], p[1]).grown(blur(p[2], p[3])));
            case FilterOp::Offset:
                return movedBack(box, p[0], p[1]);
            case FilterOp::Morphology:
                return box.grown(pixels({p[0] * scale.x, p[1] * scale.y}));
            case FilterOp::ConvolveMatrix:
                return FilterEdge(int(p[6])) == FilterEdge::Wrap ? whole : box.grown({int(p[0]), int(p[1])});
            case FilterOp::DisplacementMap: {
                const double reach = std::abs(double(p[0])) / 2;
                return k == 0 ? box.grown(pixels({reach * scale.x + 1, reach * scale.y + 1})) : box;
            }
            case FilterOp::Lighting:
                return box.grown({1, 1});
            case FilterOp::Tile:
                return whole;
            default:
                return box;
        }
    }

    /// Rounded up.
    static glm::ivec2 pixels(glm::dvec2 v) { return glm::ivec2(glm::ceil(clampedPixel(v))); }
    glm::ivec2 blur(float x, float y) const {
        return {blurReach(x * place_.scale.x), blurReach(y * place_.scale.y)};
    }
    PixelBox movedBack(const PixelBox& box, float x, float y) const {
        const glm::dvec2 by = clampedPixel(glm::dvec2(x, y) * place_.scale);
        return box.moved(-glm::ivec2(glm::round(by))).grown({1, 1});
    }

    const AssetView& asset_;
    const Filter& filter_;
    FilterPlace place_;
};

}  // namespace

View FilterPlace::viewOf(std::size_t picture) const {
    const PixelBox& box = pictures[picture];
    View view{box.width(), box.height(), pictureToRaster};
    view.toPixels[2] -= glm::dvec2(box.min);
    return view;
}

FilterPlace placeOf(const AssetView& asset, const Filter& filter, const View& below, int maxSide) {
    double coarser = 1;
    for (int tries = 0;; ++tries) {
        Placement placement(asset, filter, below, coarser);
        const double excess = placement.excess(maxSide);
        constexpr int maxTries = 64;
        if (excess <= 1 || tries == maxTries)
            return placement.take();
        coarser *= 1.1 * excess;
    }
}

}  // namespace vtm::asset

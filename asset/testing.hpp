/// \file
/// Assets built by hand, for the tests of the evaluator, the container and the GL backend.
#pragma once

#include <bit>
#include <initializer_list>
#include <vector>

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vtm/asset/asset.hpp>
#include <vtm/image/bitmap.hpp>

namespace vtm::asset::test {

inline constexpr double mapSide = 64;

inline Paint solid(glm::vec4 premultiplied) {
    return {std::bit_cast<std::uint32_t>(premultiplied.r), std::bit_cast<std::uint32_t>(premultiplied.g),
            std::bit_cast<std::uint32_t>(premultiplied.b), std::bit_cast<std::uint32_t>(premultiplied.a)};
}

inline const glm::vec4 red(1, 0, 0, 1), green(0, 1, 0, 1), blue(0, 0, 1, 1), haze(0.25f, 0.125f, 0, 0.5f);

using Point = std::array<std::uint16_t, 2>;

inline Piece line(Point a, Point b, std::uint16_t left, std::uint16_t right) {
    return {a, b, 0, 0, left, right};
}

/// An exact-mode asset: one map over [0, mapSide]², paints transparent, red, green, blue, haze.
inline Asset emptyAsset() {
    Asset asset;
    asset.width = asset.height = mapSide;
    asset.paints = {Paint{}, solid(red), solid(green), solid(blue), solid(haze)};
    asset.maps = {{0, 0, mapSide, Entry::make(Entry::Kind::Solid, 0)}};
    asset.commands = {Command{}};
    return asset;
}

inline Entry addLeaf(Asset& asset, std::array<std::uint16_t, 4> corners, const std::vector<Piece>& pieces) {
    const Leaf leaf{std::uint32_t(asset.pieces.size()), std::uint16_t(pieces.size()), 0, corners};
    asset.pieces.insert(asset.pieces.end(), pieces.begin(), pieces.end());
    asset.leaves.push_back(leaf);
    return Entry::make(Entry::Kind::Leaf, std::uint32_t(asset.leaves.size() - 1));
}

inline Asset oneLeaf(std::array<std::uint16_t, 4> corners, const std::vector<Piece>& pieces) {
    Asset asset = emptyAsset();
    asset.maps[0].root = addLeaf(asset, corners, pieces);
    return asset;
}

/// Red left of a line from side 0 to side 2, green right of it.
inline Asset halfPlane(std::uint16_t bottom = 20001, std::uint16_t top = 40003) {
    return oneLeaf({1, 2, 2, 1}, {line({bottom, 0}, {top, 65535}, 1, 2)});
}

/// Red in a wedge cut from side 0 with its tip inside, green around.
inline Asset wedge() {
    return oneLeaf({2, 2, 2, 2},
                   {line({20001, 0}, {30001, 50001}, 2, 1), line({30001, 50001}, {40001, 0}, 2, 1)});
}

/// A blue strip far thinner than a pixel, slanting from side 3 to side 1, transparent around.
inline Asset strip() {
    return oneLeaf({0, 0, 0, 0},
                   {line({0, 30000}, {65535, 40000}, 0, 3), line({0, 29900}, {65535, 39900}, 3, 0)});
}

/// Three regions meeting in an inner vertex.
inline Asset threeRegions() {
    const Point hub{33001, 30001};
    return oneLeaf({1, 1, 2, 3}, {line({65535, 20001}, hub, 1, 2), line({30001, 65535}, hub, 2, 3),
                                  line({0, 22001}, hub, 3, 1)});
}

inline constexpr glm::dvec2 discCentre(32768, 32768);
inline constexpr double discRadius = 25000;

/// A red disc of sixteen arcs, counter-clockwise, on transparent ground.
Asset disc();

/// Two levels: a node of solids, a leaf and a node of solids.
Asset twoLevels();

/// A map whose whole square is one paint program.
Asset programAsset(const std::vector<Instruction>& program, const std::vector<Texel>& arguments);

/// Appends a gradient; returns its texel.
std::uint32_t addGradient(std::vector<Texel>& data, const Gradient& gradient,
                          const std::vector<GradientStop>& stops);
std::uint32_t addImage(std::vector<Texel>& data, const ImageFill& fill);
std::uint32_t addMaterial(std::vector<Texel>& data, const MaterialFill& fill);
std::uint32_t addColor(std::vector<Texel>& data, glm::vec4 premultiplied);

/// A 4 × 3 picture of distinct straight colours, some translucent.
image::Bitmap smallPicture();

/// Every operation, gradient kind, spread and image filter and a material of one colour, in several regions
/// of several leaves.
Asset everyPaint();

/// Blends `mode` of a translucent gradient over another, in one region.
Asset blendAsset(Blend mode);

/// A slanting edge between a linear and a radial gradient, each to and fro between black and a colour, in
/// `length` units of the picture; and what that is by 32 × 32 points a pixel, where the map is.
Asset steepHalves(double length);
image::Raster steepHalvesByPoints(double length, int width, int height, const glm::dmat3x2& toPixels);
/// The same edge; its gradients do not repeat, and are of stripes `width` units wide.
Asset stripedHalves(double width);

/// Maps in maps: two of map 1, which has one of map 2, a disc. In the first it is green, in the second blue.
Asset placedMaps();

/// Every command of compat mode, with nested groups, masks and clips.
Asset layers();
/// A disc, and over it another that a filter of three primitives and two pictures draws.
Asset filtered();

}  // namespace vtm::asset::test

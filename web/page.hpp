/// \file
/// A page that shows an asset: HTML with everything in it, drawn by WebGL 2 with the shaders of
/// docs/texture.md. docs/view.md describes the page and its data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <vtm/asset/asset.hpp>

namespace vtm::web {

using Rgb = std::array<std::uint8_t, 3>;

/// What a place of the picture belongs to: an element of the source, its fill or its stroke.
struct Item {
    std::string element;
    std::uint32_t line = 0, column = 0;  ///< from 1; 0: unknown
    bool isStroke = false;
};

/// An asset, exact and without instances, whose paints have ids: 0 for nothing, i + 1 for items[i]. Without
/// items ids are called regions.
struct Ids {
    asset::Asset asset;
    std::vector<std::uint32_t> idOfPaint;
    std::vector<Item> items;
};

/// A rectangle, picture units.
struct Outline {
    double x = 0, y = 0, width = 0, height = 0;
    Rgb color{};
};

/// A mark on a scale of colours.
struct Mark {
    Rgb color{};
    std::string text;
};

/// Another view of the picture: an asset in its place, or outlines on the picture.
struct View {
    std::string name, title;
    std::optional<asset::Asset> asset;
    std::vector<Outline> outlines;
    std::vector<Mark> legend;
};

struct Source {
    std::string title;
    asset::Asset picture;    ///< exact, without filters
    double finestPixel = 0;  ///< user units: how far the page zooms
    std::optional<Ids> ids;
    std::vector<View> views;
    std::vector<std::uint8_t> svg;  ///< the file, plain or gzipped, for the browser to draw; empty: none
};

/// Throws GlError for a picture that cannot be sampled.
std::string page(const Source& source);

}  // namespace vtm::web

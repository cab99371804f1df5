#include <vtm/asset/text_page.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "asset/place.hpp"
#include "asset/walk.hpp"

namespace vtm::asset {

using glm::dvec2;

// ---- Validity ---------------------------------------------------------------------------------------

namespace {

void requireOf(bool holds, const char* what, std::size_t i, const char* how) {
    if (!holds)
        throw std::invalid_argument(fmt::format("text page: {}[{}]: {}", what, i, how));
}

bool isColor(const PageColor& color) {
    return std::ranges::all_of(color, [](float c) { return c >= 0 && c <= 1; });
}

/// Sides, and with them places and sizes, stay far from the limits of single precision.
constexpr double largestPage = 0x1p20, smallestPage = 0x1p-20;

void validateSymbols(const TextPage& page, const AssetView& font) {
    for (std::size_t i = 0; i < page.symbols.size(); ++i) {
        const PageSymbol& symbol = page.symbols[i];
        requireOf(isColor(symbol.color), "symbols", i, "colour is out of range");
        requireOf(symbol.next == 0 || (symbol.next > i && symbol.next < page.symbols.size()), "symbols", i,
                  "the next one does not follow it");
        requireOf(std::abs(symbol.offset.x) <= largestPage && std::abs(symbol.offset.y) <= largestPage,
                  "symbols", i, "offset is out of range");
        if (symbol.map == 0)
            continue;
        requireOf(symbol.map < font.maps.size() && font.maps[symbol.map].instances == 0, "symbols", i,
                  "refers to a missing map");
        const double area = glm::determinant(symbol.linear);
        requireOf(std::isfinite(area) && area != 0, "symbols", i, "matrix is singular");
        for (const double m :
             {symbol.linear[0].x, symbol.linear[0].y, symbol.linear[1].x, symbol.linear[1].y})
            requireOf(std::abs(m) <= largestPage, "symbols", i, "matrix is out of range");
    }
}

void validateCells(const TextPage& page, const PageCells& cells) {
    const std::size_t count = std::size_t(cells.columns) * cells.rows;
    requireOf(cells.columns > 0 && cells.rows > 0 && count <= maxInstances, "cells", 0,
              "number is out of range");
    requireOf(cells.symbols.size() == count, "cells", cells.symbols.size(), "symbols must be one a cell");
    requireOf(cells.colors.empty() || cells.colors.size() == count, "cells", cells.colors.size(),
              "colours must be one a cell");
    for (const double size : {cells.size.x, cells.size.y})
        requireOf(size > 0 && size <= largestPage, "cells", 0, "size is out of range");
    for (const double place : {cells.corner.x, cells.corner.y, cells.origin.x, cells.origin.y})
        requireOf(std::abs(place) <= largestPage, "cells", 0, "place is out of range");
    requireOf(page.glyphs.empty(), "cells", 0, "stand beside glyphs");
    requireOf(!page.symbols.empty() && page.symbols[0].map == 0, "symbols", 0, "is not blank");
    for (std::size_t i = 0; i < count; ++i) {
        requireOf(cells.symbols[i] < page.symbols.size(), "cells", i, "refers to a missing symbol");
        requireOf(cells.colors.empty() || cells.colors[i] < cells.palette.size(), "cells", i,
                  "refers to a missing colour");
    }
    for (std::size_t i = 0; i < cells.palette.size(); ++i)
        requireOf(isColor(cells.palette[i]), "palette", i, "colour is out of range");
}

}  // namespace

void validate(const TextPage& page, const AssetView& font) {
    for (const double side : {page.width, page.height})
        requireOf(side >= smallestPage && side <= largestPage, "page", 0, "size is out of range");
    requireOf(isColor(page.ground), "page", 0, "ground is out of range");
    requireOf(page.symbols.size() <= 0x10000, "symbols", page.symbols.size(), "there are too many");
    validateSymbols(page, font);
    for (std::size_t i = 0; i < page.glyphs.size(); ++i) {
        const PageGlyph& glyph = page.glyphs[i];
        requireOf(glyph.symbol < page.symbols.size(), "glyphs", i, "refers to a missing symbol");
        requireOf(std::abs(glyph.origin.x) <= largestPage && std::abs(glyph.origin.y) <= largestPage,
                  "glyphs", i, "place is out of range");
    }
    if (page.cells)
        validateCells(page, *page.cells);
}

PageColor colorOn(const PageColor& color, const PageColor& ground) {
    PageColor result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = color[i] * color[3] + ground[i] * ground[3] * (1 - color[3]);
    result[3] = color[3] + ground[3] * (1 - color[3]);
    return result;
}

// ---- As an asset ------------------------------------------------------------------------------------

namespace {

class PageAsset {
public:
    PageAsset(const TextPage& page, const AssetView& font) : page_(page), font_(font) {
        side_ = 2 * std::max(page.width, page.height);
        asset_.width = page.width;
        asset_.height = page.height;
        asset_.commands = {Command{}};
        asset_.finestPixel = 0;
        ground_ = colorOn(page.ground, {});
        asset_.paints = {Paint{}};
        addGround();
    }

    Asset make() {
        std::vector<PlacementInSquare> placements;
        forEachGlyph([&](const PageSymbol& symbol, dvec2 origin, const PageColor& color) {
            placements.push_back(placementOf(symbol, origin, color));
        });
        const std::uint32_t trees = appendInstances(placements, asset_);
        asset_.maps.front().instances = trees;
        asset_.fallbackLeaves = font_.fallbackLeaves;
        return std::move(asset_);
    }

private:
    template <class Visit>
    void forEachGlyph(Visit&& visit) const {
        for (const PageGlyph& glyph : page_.glyphs)
            visitShown(page_.symbols[glyph.symbol], glyph.origin, page_.symbols[glyph.symbol].color, visit);
        if (!page_.cells)
            return;
        for (std::size_t i = 0; i < page_.cells->symbols.size(); ++i)
            for (std::uint32_t s = page_.cells->symbols[i]; s != 0; s = page_.symbols[s].next)
                visitCell(i, page_.symbols[s], visit);
    }

    template <class Visit>
    void visitCell(std::size_t i, const PageSymbol& symbol, Visit&& visit) const {
        const PageCells& cells = *page_.cells;
        const dvec2 cell(double(i % cells.columns), double(i / cells.columns));
        visitShown(symbol, cells.corner + cell * cells.size + cells.origin,
                   cells.colors.empty() ? symbol.color : cells.palette[cells.colors[i]], visit);
    }

    template <class Visit>
    void visitShown(const PageSymbol& symbol, dvec2 origin, const PageColor& color, Visit&& visit) const {
        if (symbol.map == 0)
            return;
        const Affine2 place = placeOf(symbol, origin);
        const dvec2 centre = place(dvec2(0.5)),
                    reach = 0.5 * (glm::abs(place.linear[0]) + glm::abs(place.linear[1]));
        const dvec2 page = dvec2(page_.width, page_.height) / side_;
        if (glm::any(glm::greaterThanEqual(centre - reach, corner + page)) ||
            glm::any(glm::lessThanEqual(centre + reach, dvec2(corner))))
            return;  // not seen
        if (glm::any(glm::lessThan(centre, dvec2(0))) || glm::any(glm::greaterThanEqual(centre, dvec2(1))))
            throw std::invalid_argument(
                "text page: a glyph is seen, but its middle lies half a page beside the page");
        visit(symbol, origin, color);
    }

    /// From the map's [0, 1]² to the square, twice as wide as the page, that the page lies in the middle of:
    /// so the middles of glyphs may lie beside the page.
    static constexpr double corner = 0.25;  // of the page, in that square
    Affine2 placeOf(const PageSymbol& symbol, dvec2 origin) const {
        const Map& map = font_.maps[symbol.map];
        const Affine2 toPage{symbol.linear / side_, (origin + symbol.offset) / side_ + corner};
        return compose(toPage, asset::placeOf(map));
    }

    PlacementInSquare placementOf(const PageSymbol& symbol, dvec2 origin, const PageColor& color) {
        const auto [map, isNew] = maps_.try_emplace(symbol.map, std::uint16_t(0));
        if (isNew)
            map->second = appendMap(extractMap(font_, symbol.map), asset_);
        const Affine2 place = placeOf(symbol, origin);
        include(symbol, place);
        return {map->second, {groundPaint_, paintOf(colorOn(color, page_.ground))}, place};
    }

    /// How far the page may be magnified: the glyph's own error, enlarged, and that of its stored place.
    void include(const PageSymbol& symbol, const Affine2& place) {
        const double enlarged = std::max(glm::length(symbol.linear[0]), glm::length(symbol.linear[1])) *
                                font_.finestPixel.value_or(0);
        const double stored = (placementError(place.linear) + 0.5 / centreSteps) * side_;
        asset_.finestPixel = std::max(*asset_.finestPixel, enlarged + stored / finestShare);
    }

    std::uint16_t paintOf(const PageColor& color) {
        const auto [paint, isNew] = paints_.try_emplace(color, std::uint16_t(asset_.paints.size()));
        if (isNew)
            asset_.paints.push_back(std::bit_cast<Paint>(color));
        return paint->second;
    }

    /// The page lies in the middle four of the root's sixteen cells, and fills them along its longer side.
    void addGround() {
        asset_.maps = {{-corner * side_, -corner * side_, side_, Entry::make(Entry::Kind::Solid, 0), 0}};
        if (ground_[3] == 0)
            return;
        groundPaint_ = paintOf(ground_);
        Node node;
        for (int y = 1; y <= 2; ++y)
            for (int x = 1; x <= 2; ++x)
                node.children[std::size_t(4 * y + x)] =
                    groundCell({4 * page_.width / side_ - (x - 1), 4 * page_.height / side_ - (y - 1)});
        asset_.nodes = {node};
        asset_.maps.front().root = Entry::make(Entry::Kind::Node, 0);
        asset_.finestPixel = 0.5 / leafExtent * side_ / 4 / finestShare;
    }

    /// A cell that the page covers from its min corner up to `end`, along one of the axes at least all of it.
    Entry groundCell(dvec2 end) {
        const auto stored = [](double place) {
            return std::uint16_t(std::lround(std::clamp(place, 0.0, 1.0) * double(leafExtent)));
        };
        const std::uint16_t x = stored(end.x), y = stored(end.y), all = leafExtent, g = groundPaint_;
        if (x == 0 || y == 0)
            return Entry::make(Entry::Kind::Solid, 0);
        if (x == all && y == all)
            return Entry::make(Entry::Kind::Solid, g);
        Piece piece;  // the page lies on its left
        Leaf leaf;
        leaf.firstPiece = std::uint32_t(asset_.pieces.size());
        leaf.pieceCount = 1;
        if (x == all) {
            piece.a = {all, y};
            piece.b = {0, y};
            leaf.corners = {g, g, 0, 0};
        } else {
            piece.a = {x, 0};
            piece.b = {x, all};
            leaf.corners = {g, 0, 0, g};
        }
        piece.left = g;
        asset_.pieces.push_back(piece);
        asset_.leaves.push_back(leaf);
        return Entry::make(Entry::Kind::Leaf, std::uint32_t(asset_.leaves.size() - 1));
    }

    const TextPage& page_;
    const AssetView& font_;
    double side_ = 1;
    PageColor ground_{};
    std::uint16_t groundPaint_ = 0;
    Asset asset_;
    std::map<std::uint32_t, std::uint16_t> maps_;
    std::map<PageColor, std::uint16_t> paints_;
};

}  // namespace

Asset pageAsset(const TextPage& page, const AssetView& font) {
    validate(page, font);
    try {
        return PageAsset(page, font).make();
    } catch (const TooManyInstances& error) {
        throw std::invalid_argument(error.what());
    }
}

}  // namespace vtm::asset

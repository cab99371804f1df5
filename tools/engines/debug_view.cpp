#include "tools/engines/debug_view.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "asset/instances.hpp"
#include "asset/walk.hpp"
#include "backend_gl/debug.hpp"
#include "compiler/cost.hpp"
#include "tools/process/errors.hpp"

namespace vtm::tools {

namespace {

using asset::Asset;
using asset::Entry;
using glm::vec3;

// ---- Colours --------------------------------------------------------------------------------------

/// Navy, blue, green, yellow, red, for t from 0 to 1.
vec3 heat(double t) {
    static constexpr std::array<std::array<float, 3>, 5> stops{{{0.10f, 0.15f, 0.36f},
                                                                {0.16f, 0.50f, 0.75f},
                                                                {0.30f, 0.75f, 0.48f},
                                                                {0.96f, 0.80f, 0.30f},
                                                                {0.84f, 0.14f, 0.20f}}};
    const double at = std::clamp(t, 0.0, 1.0) * double(stops.size() - 1);
    const auto i = std::min(std::size_t(at), stops.size() - 2);
    const auto color = [&](std::size_t k) { return vec3(stops[k][0], stops[k][1], stops[k][2]); };
    return glm::mix(color(i), color(i + 1), float(at - double(i)));
}

constexpr double maxLevel = 6;    ///< level that is red
constexpr double maxPieces = 64;  ///< pieces of a leaf that are red, by their logarithm
constexpr double maxNanoseconds = 2000;
const vec3 pale(0.92f);

asset::Paint paintOf(vec3 c) {
    return {std::bit_cast<std::uint32_t>(c.r), std::bit_cast<std::uint32_t>(c.g),
            std::bit_cast<std::uint32_t>(c.b), std::bit_cast<std::uint32_t>(1.0f)};
}

std::uint32_t piecesOf(const Asset& asset, Entry entry) {
    return entry.kind() == Entry::Kind::Leaf ? asset.leaves[entry.payload()].pieceCount : 0;
}

vec3 depthColor(const Asset&, Entry, unsigned level) { return heat(level / maxLevel); }

vec3 piecesColor(const Asset& asset, Entry entry, unsigned) {
    const std::uint32_t pieces = piecesOf(asset, entry);
    return pieces == 0 ? pale : heat(std::log2(pieces) / std::log2(maxPieces));
}

/// Nanoseconds a pixel by the compiler's model, each leaf alone.
vec3 costColor(const Asset& asset, Entry entry, unsigned level) {
    using compiler::CostModel;
    const double side = CostModel::nominalPixels / std::exp2(2.0 * level);
    const double perPixel = CostModel{}.drawing(piecesOf(asset, entry), level) / (side * side);
    return heat(std::log2(perPixel / CostModel::perSolidFragment) /
                std::log2(maxNanoseconds / CostModel::perSolidFragment));
}

// ---- Squares of one colour ------------------------------------------------------------------------

using ColorOf = vec3 (*)(const Asset&, Entry, unsigned level);

/// The same trees, every square of one colour, without the maps that are placed in them.
class Squares {
public:
    Squares(const Asset& asset, ColorOf colorOf) : from_(asset), colorOf_(colorOf) {
        to_.width = asset.width;
        to_.height = asset.height;
        to_.maps = asset.maps;
        to_.commands = asset.commands;
        to_.paints = {asset::Paint{}};
        for (asset::Map& map : to_.maps) {
            map.root = made(map.root, 0);
            map.instances = 0;
        }
    }
    Asset take() { return std::move(to_); }

private:
    Entry made(Entry entry, unsigned level) {
        if (entry.kind() != Entry::Kind::Node)
            return Entry::make(Entry::Kind::Solid, paint(colorOf_(from_, entry, level)));
        // Places may share a node, and it is another one on another level.
        const std::pair key(entry.payload(), level);
        if (const auto found = nodes_.find(key); found != nodes_.end())
            return found->second;
        const auto index = std::uint32_t(to_.nodes.size());
        to_.nodes.emplace_back();
        for (std::size_t i = 0; i < 16; ++i) {
            const Entry child = made(from_.nodes[entry.payload()].children[i], level + 1);
            to_.nodes[index].children[i] = child;
        }
        return nodes_[key] = Entry::make(Entry::Kind::Node, index);
    }
    std::uint32_t paint(vec3 color) {
        const asset::Paint made = paintOf(color);
        const auto [place, isNew] = paints_.try_emplace(made, std::uint32_t(to_.paints.size()));
        if (isNew)
            to_.paints.push_back(made);
        return place->second;
    }

    const Asset& from_;
    ColorOf colorOf_;
    Asset to_;
    std::map<std::pair<std::uint32_t, unsigned>, Entry> nodes_;
    std::map<asset::Paint, std::uint32_t> paints_;
};

/// A colour of its own for every paint but the transparent one: hues a golden ratio apart, in three shades.
Asset regionsAsset(Asset asset) {
    constexpr double golden = 0.6180339887;
    for (std::size_t i = 1; i < asset.paints.size(); ++i) {
        if (asset.paints[i] == asset::Paint{})
            continue;
        const double hue = 6 * std::fmod(double(i) * golden, 1.0);
        const auto channel = [&](double shift) {
            const double h = std::fmod(hue + shift, 6.0);
            return float(std::clamp(std::abs(h - 3) - 1, 0.0, 1.0));
        };
        const float shade = 0.55f + 0.2f * float(i % 3);
        asset.paints[i] = paintOf(shade * (0.25f + 0.75f * vec3(channel(0), channel(4), channel(2))));
    }
    asset.data.clear();
    asset.images.clear();
    asset.materials.clear();
    return asset;
}

// ---- Lines ----------------------------------------------------------------------------------------

class Canvas {
public:
    Canvas(image::Bitmap& bitmap, const asset::View& view) : bitmap_(bitmap), view_(view) {}

    glm::dvec2 pixel(double x, double y) const { return view_.toPixels * glm::dvec3(x, y, 1); }

    /// Towards white, so that lines show.
    void fade() {
        for (std::size_t i = 0; i < bitmap_.rgba.size(); i += 4)
            blend(i, vec3(1), 0.55f);
    }
    /// Picture units.
    void outline(double x, double y, double side, vec3 color) {
        const glm::ivec2 from(glm::floor(limited(pixel(x, y)))),
            to(glm::floor(limited(pixel(x + side, y + side))));
        fill({from.x, from.y}, {to.x + 1, from.y + 1}, color);
        fill({from.x, from.y + 1}, {from.x + 1, to.y + 1}, color);
    }
    /// All four sides.
    void frame(glm::dvec2 corner, glm::dvec2 size, vec3 color) {
        const glm::ivec2 from(glm::floor(limited(pixel(corner.x, corner.y)))),
            to(glm::floor(limited(pixel(corner.x + size.x, corner.y + size.y))));
        fill(from, {to.x + 1, from.y + 1}, color);
        fill({from.x, to.y}, to + 1, color);
        fill(from, {from.x + 1, to.y + 1}, color);
        fill({to.x, from.y}, to + 1, color);
    }
    /// At least some pixels wide, so that it can be seen.
    void mark(double x, double y, double side, vec3 color) {
        constexpr double minimum = 5;
        const glm::dvec2 from = pixel(x, y), to = pixel(x + side, y + side);
        const glm::dvec2 middle = (from + to) * 0.5, half = glm::max((to - from) * 0.5, minimum / 2);
        fill(glm::ivec2(glm::floor(limited(middle - half))), glm::ivec2(glm::ceil(limited(middle + half))),
             color);
    }

private:
    glm::dvec2 limited(glm::dvec2 p) const {
        return glm::clamp(p, glm::dvec2(-1), glm::dvec2(bitmap_.width, bitmap_.height) + 1.0);
    }
    void fill(glm::ivec2 from, glm::ivec2 to, vec3 color) {
        from = glm::max(from, 0);
        to = glm::min(to, glm::ivec2(bitmap_.width, bitmap_.height));
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x)
                blend((std::size_t(y) * std::size_t(bitmap_.width) + std::size_t(x)) * 4, color, 1);
    }
    void blend(std::size_t at, vec3 color, float share) {
        const float ground = float(bitmap_.rgba[at + 3]) / 255;
        for (std::size_t c = 0; c < 3; ++c) {
            const float below = glm::mix(255.0f, float(bitmap_.rgba[at + c]), ground);
            bitmap_.rgba[at + c] =
                std::uint8_t(std::lround(glm::mix(below, 255 * color[glm::length_t(c)], share)));
        }
        bitmap_.rgba[at + 3] = 255;
    }

    image::Bitmap& bitmap_;
    const asset::View& view_;
};

const vec3 placedColor(0.55f, 0.2f, 0.7f);

/// visit(corner, size, color, isPlaced) for the squares of each map that is drawn, then for the boxes around
/// the maps that are placed in it.
template <class Visit>
void forEachCell(const Asset& asset, Visit&& visit) {
    for (const asset::Command& command : asset.commands) {
        const asset::Map& map = asset.maps[command.map];
        asset::walk(asset, map.root, [&](asset::Cell cell, Entry) {
            const double side = map.side / std::exp2(2.0 * cell.level);
            visit(glm::dvec2(map.x, map.y) + glm::dvec2(cell.x, cell.y) * side, glm::dvec2(side),
                  heat(cell.level / maxLevel), false);
        });
        asset::forEachMap(asset, map, [&](const asset::PlacedMap& placed) {
            const glm::dmat2& linear = placed.toPicture.linear;
            const glm::dvec2 size = glm::abs(linear[0]) + glm::abs(linear[1]);
            const glm::dvec2 corner = placed.toPicture(glm::dvec2(0.5)) - 0.5 * size;
            if (&placed.map != &map)
                visit(corner, size, placedColor, true);
            return true;
        });
    }
}

void drawCells(Canvas& canvas, const Asset& asset) {
    forEachCell(asset, [&](glm::dvec2 corner, glm::dvec2 size, vec3 color, bool isPlaced) {
        isPlaced ? canvas.frame(corner, size, color) : canvas.outline(corner.x, corner.y, size.x, color);
    });
}

void drawTiles(Canvas& canvas, const Asset& asset, const asset::View& view) {
    for (const asset::Command& command : asset.commands) {
        const asset::Map& map = asset.maps[command.map];
        const gl::TileGrid grid = gl::tileGrid(map, view);
        const glm::dvec2 scale(view.toPixels[0].x, view.toPixels[1].y), origin = view.toPixels[2];
        const glm::dvec2 corner(map.x, map.y), size(view.width, view.height);
        const glm::dvec2 from = glm::floor((-origin / scale - corner) / grid.side),
                         to = glm::ceil(((size - origin) / scale - corner) / grid.side);
        for (double y = from.y; y < to.y; ++y)
            for (double x = from.x; x < to.x; ++x)
                canvas.outline(corner.x + x * grid.side, corner.y + y * grid.side, grid.side, heat(1));
    }
}

/// The colour scale's stops.
std::vector<DebugMark> marksAt(std::initializer_list<const char*> texts) {
    std::vector<DebugMark> marks;
    for (const char* text : texts)
        marks.push_back({heat(double(marks.size()) / double(texts.size() - 1)), text});
    return marks;
}

}  // namespace

DebugView parseDebugView(const std::string& name) {
    for (const auto& [known, view] : {std::pair{"", DebugView::None},
                                      {"cells", DebugView::Cells},
                                      {"depth", DebugView::Depth},
                                      {"pieces", DebugView::Pieces},
                                      {"cost", DebugView::Cost},
                                      {"regions", DebugView::Regions},
                                      {"fallback", DebugView::Fallback},
                                      {"tiles", DebugView::Tiles}})
        if (name == known)
            return view;
    throw UsageError("--debug-view: '" + name +
                     "' is not one of cells, depth, pieces, cost, regions, fallback, tiles");
}

void prepare(Source& source, DebugView view) {
    if (view == DebugView::None)
        return;
    if (!source.asset || source.asset->mode != asset::Mode::Exact)
        throw UsageError("--debug-view: needs exact mode and an engine that draws from an asset");
    if (view == DebugView::Fallback && !source.proof)
        throw UsageError(
            "--debug-view fallback: needs an SVG file; a .vtm file does not record these squares");
    if (std::optional<Asset> shown = debugAsset(*source.asset, view))
        source.asset = std::move(*shown);
}

std::optional<asset::Asset> debugAsset(const Asset& asset, DebugView view) {
    switch (view) {
        case DebugView::Depth:
            return Squares(asset, depthColor).take();
        case DebugView::Pieces:
            return Squares(asset, piecesColor).take();
        case DebugView::Cost:
            return Squares(asset, costColor).take();
        case DebugView::Regions:
            return regionsAsset(asset);
        default:
            return std::nullopt;
    }
}

std::vector<DebugOutline> debugOutlines(const Asset& asset,
                                        const std::vector<compiler::UnprovenSquare>& unproven,
                                        DebugView view) {
    std::vector<DebugOutline> outlines;
    if (view == DebugView::Cells)
        forEachCell(asset, [&](glm::dvec2 corner, glm::dvec2 size, vec3 color, bool) {
            outlines.push_back({corner, size, color});
        });
    if (view == DebugView::Fallback)
        for (const compiler::UnprovenSquare& square : unproven)
            outlines.push_back({{square.x, square.y}, glm::dvec2(square.side), heat(1)});
    return outlines;
}

std::vector<DebugMark> debugLegend(DebugView view) {
    switch (view) {
        case DebugView::Cells:
        case DebugView::Depth:
            return marksAt({"level 0", "1.5", "3", "4.5", "6 and deeper"});
        case DebugView::Pieces:
            return marksAt({"1 piece", "2.8", "8", "23", "64 and more"});
        case DebugView::Cost:
            return marksAt({"5 ns a pixel", "22", "100", "447", "2000 and more"});
        default:
            return {};
    }
}

void layLines(image::Bitmap& picture, DebugView view, const Source& source, const asset::View& to) {
    Canvas canvas(picture, to);
    if (view == DebugView::Cells || view == DebugView::Fallback || view == DebugView::Tiles)
        canvas.fade();
    if (view == DebugView::Cells)
        drawCells(canvas, *source.asset);
    if (view == DebugView::Tiles)
        drawTiles(canvas, *source.asset, to);
    if (view == DebugView::Fallback)
        for (const compiler::UnprovenSquare& square : source.proof->unproven)
            canvas.mark(square.x, square.y, square.side, heat(1));
}

}  // namespace vtm::tools

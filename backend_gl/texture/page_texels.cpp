#include "backend_gl/texture/page_texels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include <glm/common.hpp>

#include "asset/instances.hpp"
#include "backend_gl/upload/asset_texels.hpp"

namespace vtm::gl {
namespace {

using asset::PageSymbol;
using asset::Texel;
using asset::TextPage;
using glm::dvec2;

std::uint32_t bitsOf(double value) { return std::bit_cast<std::uint32_t>(float(value)); }
Texel floats(double x, double y, double z, double w) { return {bitsOf(x), bitsOf(y), bitsOf(z), bitsOf(w)}; }

/// Places of glyphs: 24 bits over twice the page's side, from half a side before it on.
constexpr double placeSteps = 1u << 23, firstPlace = -0.5;

std::uint32_t stepsOf(double place) {
    return std::uint32_t(std::clamp(std::round((place - firstPlace) * placeSteps), 0.0, 2 * placeSteps - 1));
}
bool isStorable(dvec2 place) {
    return std::min(place.x, place.y) >= firstPlace && std::max(place.x, place.y) < firstPlace + 2;
}

class PageTexels {
public:
    PageTexels(const TextPage& page, const asset::AssetView& font, GLuint first)
        : page_(page), font_(font), first_(first), side_(std::max(page.width, page.height)) {
        for (const PageSymbol& symbol : page.symbols)
            places_.push_back(placeOf(symbol));
    }

    std::vector<Texel> make() {
        texels_.resize(2);
        const GLuint symbols = addSymbols();
        if (page_.cells)
            addCells(*page_.cells);
        else
            addGlyphs();
        const GLuint layers = first_ + GLuint(texels_.size());
        for (const std::array<Texel, 4>& layer : layers_)
            texels_.insert(texels_.end(), layer.begin(), layer.end());
        const asset::PageColor ground = asset::colorOn(page_.ground, {});
        texels_[0] = {GLuint(layers_.size()), layers, symbols, page_.cells ? 3u : 2u};
        texels_[1] = floats(ground[0], ground[1], ground[2], ground[3]);
        return std::move(texels_);
    }

private:
    /// From the map's [0, 1]² to the page's square, with the symbol at (0, 0).
    asset::Affine2 placeOf(const PageSymbol& symbol) const {
        if (symbol.map == 0)
            return {};
        return asset::compose({symbol.linear / side_, symbol.offset / side_},
                              asset::placeOf(font_.maps[symbol.map]));
    }
    static dvec2 reachOf(const asset::Affine2& place) {
        return 0.5 * (glm::abs(place.linear[0]) + glm::abs(place.linear[1]));
    }

    template <class Record>
    GLuint append(const std::vector<Record>& records) {
        return first_ + appendTexels<Record>(texels_, records);
    }

    GLuint addSymbols() {
        const GLuint first = first_ + GLuint(texels_.size());
        for (std::size_t i = 0; i < page_.symbols.size(); ++i) {
            const PageSymbol& symbol = page_.symbols[i];
            const asset::PageColor color = asset::colorOn(symbol.color, page_.ground);
            const auto unorm = [&](std::size_t low) {
                const auto of = [](float c) { return std::uint32_t(std::lround(c * 65535)); };
                return of(color[low]) | of(color[low + 1]) << 16;
            };
            const asset::Affine2& place = places_[i];
            const std::uint32_t root = symbol.map == 0 ? 0 : font_.maps[symbol.map].root.bits;
            texels_.push_back({root, symbol.next, unorm(0), unorm(2)});
            texels_.push_back(
                floats(place.linear[0].x, place.linear[0].y, place.linear[1].x, place.linear[1].y));
            if (!page_.cells)
                continue;
            const dvec2 centre = inCell(place(dvec2(0.5)));
            texels_.push_back(floats(centre.x, centre.y, 0, 0));
        }
        return first;
    }

    dvec2 inCell(dvec2 centre) const { return page_.cells ? centre + page_.cells->origin / side_ : centre; }

    void addLayer(glm::uvec2 count, GLuint cells, GLuint glyphs, dvec2 corner, dvec2 size, dvec2 reachBefore,
                  dvec2 reachBehind, GLuint colors = 0, GLuint palette = 0) {
        layers_.push_back({Texel{count.x, count.y, cells, glyphs}, floats(corner.x, corner.y, size.x, size.y),
                           floats(reachBefore.x, reachBefore.y, reachBehind.x, reachBehind.y),
                           Texel{glyphs == 0 ? 1u : 0u, colors, palette, 0}});
    }

    void addCells(const asset::PageCells& cells) {
        const dvec2 size = cells.size / side_;
        dvec2 before(0), behind(0);
        for (std::size_t i = 0; i < page_.symbols.size(); ++i) {
            if (page_.symbols[i].map == 0)
                continue;
            const dvec2 centre = inCell(places_[i](dvec2(0.5))), reach = reachOf(places_[i]);
            before = glm::max(before, reach - centre);
            behind = glm::max(behind, centre + reach - size);
        }
        const GLuint symbols = append(cells.symbols);
        GLuint colors = 0, palette = 0;
        if (!cells.colors.empty()) {
            colors = append(cells.colors);
            std::vector<Texel> inks;
            for (const asset::PageColor& color : cells.palette)
                inks.push_back(std::bit_cast<Texel>(asset::colorOn(color, page_.ground)));
            palette = append(inks);
        }
        addLayer({cells.columns, cells.rows}, symbols, 0, cells.corner / side_, size, before, behind, colors,
                 palette);
    }

    // ---- Glyphs anywhere ----

    struct Placed {
        dvec2 centre;
        std::uint16_t symbol;
    };

    /// Those of one size, give or take an octave, in a layer of their own.
    void addGlyphs() {
        std::map<int, std::vector<Placed>> bySize;
        for (const asset::PageGlyph& glyph : page_.glyphs) {
            const dvec2 centre = glyph.origin / side_ + places_[glyph.symbol](dvec2(0.5));
            const dvec2 reach = reachOf(places_[glyph.symbol]);
            const dvec2 end(page_.width / side_, page_.height / side_);
            const bool isSeen = glm::all(glm::lessThan(centre - reach, end)) &&
                                glm::all(glm::greaterThan(centre + reach, dvec2(0)));
            if (page_.symbols[glyph.symbol].map == 0 || !isSeen)
                continue;
            if (!isStorable(centre))
                throw GlError("a glyph is so large that its centre lies half a page beyond the page");
            bySize[std::ilogb(std::max(reach.x, reach.y)) / 2].push_back({centre, glyph.symbol});
        }
        for (auto& [size, glyphs] : bySize)
            addGrid(std::move(glyphs));
    }

    static constexpr double usualGlyphs =
        6;  ///< in a cell: a pixel asks each of them, and a cell takes 4 bytes
    static constexpr std::size_t maxInCell = 255, maxCells = std::size_t(1) << 22;

    void addGrid(std::vector<Placed> glyphs) {
        dvec2 min(2), max(-1), reach(0);
        for (const Placed& glyph : glyphs) {
            min = glm::min(min, glyph.centre);
            max = glm::max(max, glyph.centre);
            reach = glm::max(reach, reachOf(places_[glyph.symbol]));
        }
        const dvec2 size = glm::max(max - min, dvec2(1 / placeSteps)) * (1 + 0x1p-20);
        double cell = std::sqrt(usualGlyphs * size.x * size.y / double(glyphs.size()));
        for (;; cell *= 0.5) {
            const dvec2 wanted = glm::clamp(glm::ceil(size / cell), dvec2(1), dvec2(1 << 16));
            const glm::uvec2 count(wanted);
            if (std::size_t(count.x) * count.y > maxCells)
                throw GlError("more than 255 glyphs stand in one place of a page");
            if (addGrid(glyphs, count, min, size / wanted, reach))
                return;
        }
    }

    bool addGrid(std::vector<Placed>& glyphs, glm::uvec2 count, dvec2 corner, dvec2 size, dvec2 reach) {
        const auto cellOf = [&](const Placed& glyph) {
            const glm::uvec2 at = glm::min(glm::uvec2((glyph.centre - corner) / size), count - 1u);
            return std::size_t(at.y) * count.x + at.x;
        };
        std::ranges::stable_sort(glyphs, {}, cellOf);
        std::vector<std::uint32_t> cells(std::size_t(count.x) * count.y, 0);
        for (std::size_t i = 0; i < glyphs.size();) {
            const std::size_t cell = cellOf(glyphs[i]), first = i;
            while (i < glyphs.size() && cellOf(glyphs[i]) == cell)
                ++i;
            if (i - first > maxInCell)
                return false;
            cells[cell] = std::uint32_t(first) | std::uint32_t(i - first) << 24;
        }
        std::vector<std::array<std::uint32_t, 2>> records;
        for (const Placed& glyph : glyphs)
            records.push_back({stepsOf(glyph.centre.x) | std::uint32_t(glyph.symbol & 0xFFu) << 24,
                               stepsOf(glyph.centre.y) | std::uint32_t(glyph.symbol >> 8) << 24});
        const GLuint cellTexels = append(cells), glyphTexels = append(records);
        addLayer(count, cellTexels, glyphTexels, corner, size, reach, reach);
        return true;
    }

    const TextPage& page_;
    const asset::AssetView& font_;
    const GLuint first_;
    const double side_;
    std::vector<asset::Affine2> places_;
    std::vector<Texel> texels_;
    std::vector<std::array<Texel, 4>> layers_;
};

}  // namespace

std::vector<Texel> pageTexels(const TextPage& page, const asset::AssetView& font, GLuint first) {
    return PageTexels(page, font, first).make();
}

}  // namespace vtm::gl

#include <vtm/font/typesetter.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <vtm/limits/limits.hpp>
#include "font/contact.hpp"
#include "font/glyph_maps.hpp"
#include "font/tag.hpp"
#include "text/shape.hpp"
#include "text/utf8.hpp"

namespace vtm::font {
namespace {

using asset::PageGlyph;
using asset::PageSymbol;
using asset::TextPage;
using glm::dvec2;
using text::GlyphId;

constexpr std::size_t maxSymbols = 0x10000, maxCellSymbols = 0x100;

void require(bool holds, const char* what) {
    if (!holds)
        throw std::invalid_argument(what);
}

bool isPositive(double value) { return std::isfinite(value) && value > 0; }

/// A glyph where its line has it: ems, from the line's start; y down.
struct LineGlyph {
    GlyphId id = 0;
    dvec2 at{0};
    bool sideways = false;  ///< turned 90° clockwise
};

/// Turns a sideways glyph's points.
dvec2 turned(dvec2 p) { return {-p.y, p.x}; }

/// Symbols of a page, each once.
class Symbols {
public:
    explicit Symbols(TextPage& page) : page_(page) {}

    std::uint16_t of(std::uint32_t map, double size, bool sideways, const Color& color) {
        const auto [known, isNew] = known_.try_emplace({map, size, sideways, color}, page_.symbols.size());
        if (isNew) {
            if (page_.symbols.size() == maxSymbols)
                throw LimitError("a page of text has at most 65535 symbols");
            const glm::dmat2 linear = sideways ? glm::dmat2(0, size, -size, 0) : glm::dmat2(size);
            page_.symbols.push_back({map, linear, color});
        }
        return std::uint16_t(known->second);
    }

private:
    TextPage& page_;
    std::map<std::tuple<std::uint32_t, double, bool, Color>, std::size_t> known_;
};

}  // namespace

std::u32string fromUtf8(std::string_view text) {
    std::u32string characters;
    while (!text.empty())
        characters += text::readCharacter(text);
    return characters;
}

// ---- Outlines that touch ----------------------------------------------------------------------------

namespace {

/// Of one font: flattens each glyph once, and remembers what it found.
class Contacts {
public:
    explicit Contacts(const GlyphMaps& font) : font_(font) {}

    /// `b` from `a`, ems.
    bool touch(GlyphId a, GlyphId b, dvec2 between) {
        const Polygons &first = polygonsOf(a), &second = polygonsOf(b);
        if (first.rings.empty() || second.rings.empty())
            return false;
        const geometry::Box moved{second.box.min + between, second.box.max + between};
        if (moved.intersection(first.box).empty())
            return false;
        const auto [known, isNew] = touch_.try_emplace({a, b, between.x, between.y}, false);
        if (isNew)
            known->second = font::touch(second, between, first);
        return known->second;
    }

private:
    const Polygons& polygonsOf(GlyphId glyph) {
        const auto known = polygons_.find(glyph);
        if (known != polygons_.end())
            return known->second;
        const auto outline = font_.outlineOf(glyph);
        const scene::Path inEms = outline ? mapped(*outline, 1 / font_.em(), dvec2(0)) : scene::Path();
        return polygons_.emplace(glyph, Polygons(inEms)).first->second;
    }

    const GlyphMaps& font_;
    std::map<GlyphId, Polygons> polygons_;
    std::map<std::tuple<GlyphId, GlyphId, double, double>, bool> touch_;
};

/// How many glyphs before it in the line a glyph may touch: a base with its marks, and the letters beside.
constexpr std::size_t reach = 12;

/// Groups of glyphs that touch each other, by the index of their first.
std::vector<std::size_t> groupsOf(const std::vector<LineGlyph>& glyphs, Contacts& contacts) {
    std::vector<std::size_t> group(glyphs.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto rootOf = [&](std::size_t i) {
        while (group[i] != i)
            i = group[i];
        return i;
    };
    for (std::size_t i = 0; i < glyphs.size(); ++i)
        for (std::size_t j = i - std::min(i, reach); j < i; ++j) {
            if (glyphs[i].sideways != glyphs[j].sideways)
                continue;
            dvec2 between = glyphs[i].at - glyphs[j].at;
            if (glyphs[i].sideways)
                between = {between.y, -between.x};
            if (contacts.touch(glyphs[j].id, glyphs[i].id, between)) {
                const std::size_t a = rootOf(i), b = rootOf(j);
                group[std::max(a, b)] = std::min(a, b);
            }
        }
    for (std::size_t i = 0; i < group.size(); ++i)
        group[i] = rootOf(i);
    return group;
}

}  // namespace

// ---- Lines ------------------------------------------------------------------------------------------

struct Typesetter::Impl {
    Impl(GlyphMaps& of, double width, double height, Color ground) : font(of), contacts(of), symbols(page) {
        page.width = width;
        page.height = height;
        page.ground = ground;
        page.symbols.push_back({});
    }

    std::vector<text::Cluster> shaped(std::u32string_view characters, const TextStyle& style) {
        text::Line line;
        line.text = characters;
        line.rightToLeft = style.rightToLeft;
        line.vertical = style.vertical;
        text::Span span{characters.size(), font.query, {}, style.language, text::TextOrientation::Mixed};
        for (const Feature& feature : style.features)
            span.features.push_back({tagOf(feature.tag), feature.value});
        line.spans.push_back(std::move(span));
        return text::shape(line, font.fonts);
    }

    /// Advances by character, ems: of the cluster that begins there.
    std::vector<double> advancesOf(std::u32string_view characters, const TextStyle& style) {
        std::vector<double> advances(characters.size(), 0);
        for (const text::Cluster& cluster : shaped(characters, style))
            advances[cluster.first] += cluster.advance;
        return advances;
    }

    /// `from` is the line's start, at its baseline. Returns the line's length, ems.
    std::vector<LineGlyph> glyphsOf(std::u32string_view characters, const TextStyle& style, double& length) {
        std::vector<LineGlyph> glyphs;
        double pen = 0;
        for (const text::Cluster& cluster : shaped(characters, style)) {
            double inside = 0;
            for (const text::Glyph& glyph : cluster.glyphs) {
                const dvec2 offset(glyph.x, glyph.y);
                dvec2 at;
                if (!style.vertical)
                    at = dvec2(pen + inside, 0) + offset;
                else if (cluster.sideways)
                    at = dvec2(0, pen + inside) + turned(offset + dvec2(0, sidewaysBaseline()));
                else
                    at = dvec2(0, pen + inside) + offset;
                glyphs.push_back({glyph.id, at, cluster.sideways});
                inside += glyph.advance;
            }
            pen += cluster.advance;
        }
        length = pen;
        return glyphs;
    }

    /// The middle between ascent and descent stands on the middle of a vertical line.
    double sidewaysBaseline() const {
        const text::FontMetrics& metrics = font.font->metrics();
        return 0.5 * (metrics.ascent - metrics.descent) / font.font->unitsPerEm();
    }

    void place(const std::vector<LineGlyph>& glyphs, dvec2 start, const TextStyle& style) {
        const std::vector<std::size_t> groups = groupsOf(glyphs, contacts);
        std::map<std::size_t, std::vector<GlyphAt>> members;
        for (std::size_t i = 0; i < glyphs.size(); ++i) {
            const LineGlyph& first = glyphs[groups[i]];
            const dvec2 from = glyphs[i].at - first.at;
            members[groups[i]].push_back(
                {glyphs[i].id, inUnits(first.sideways ? dvec2(from.y, -from.x) : from)});
        }
        for (const auto& [i, group] : members) {
            const auto& parts = group.size() == 1 ? font.partsOf(group[0].id) : font.partsOf(group);
            for (const asset::GlyphPart& part : parts) {
                const std::uint16_t symbol =
                    symbols.of(part.map, style.size, glyphs[i].sideways, style.color);
                const dvec2 offset(part.x, part.y);
                const dvec2 at = glyphs[i].at + (glyphs[i].sideways ? turned(offset) : offset);
                page.glyphs.push_back({symbol, start + at * style.size});
            }
        }
    }

    /// HarfBuzz's places are whole numbers of these, so equal groups are told by equal numbers.
    dvec2 inUnits(dvec2 ems) const {
        const double steps = font.em() * text::Font::harfbuzzScale;
        return glm::round(ems * steps) / double(text::Font::harfbuzzScale);
    }

    GlyphMaps& font;
    Contacts contacts;
    TextPage page;
    Symbols symbols;
};

namespace {

bool isLineFeed(char32_t c) { return c == U'\n' || c == U'\r' || c == U'\u2028' || c == U'\u2029'; }
bool isBlank(char32_t c) { return c == U' ' || c == U'\t' || isLineFeed(c); }

/// Where the first paragraph ends: behind its line feed.
std::size_t paragraphEnd(std::u32string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i)
        if (isLineFeed(text[i]))
            return text.substr(i, 2) == U"\r\n" ? i + 2 : i + 1;
    return text.size();
}

/// Where the line of a paragraph ends that begins at `first`: greedy, as many words as fit; blanks stick out.
std::size_t lineEnd(std::u32string_view text, std::size_t first, const std::vector<bool>& breaks,
                    const std::vector<double>& advances, double room) {
    double width = 0;
    std::size_t allowed = first;
    for (std::size_t i = first; i < text.size(); ++i) {
        width += advances[i];
        if (width > room && !isBlank(text[i]) && allowed > first)
            return allowed;
        if (breaks[i])
            allowed = i + 1;
    }
    return text.size();
}

std::u32string_view withoutBlanksAtEnd(std::u32string_view line) {
    while (!line.empty() && isBlank(line.back()))
        line.remove_suffix(1);
    return line;
}

void check(const TextBox& box, const TextStyle& style) {
    require(isPositive(style.size) && isPositive(style.lineHeight), "typesetter: sizes must be positive");
    for (const Feature& feature : style.features)
        tagOf(feature.tag);
    for (const double length : {box.x, box.y, box.width, box.height})
        require(std::isfinite(length), "typesetter: a box's lengths must be finite");
}

/// Where a line of that length begins.
double startOf(Align align, bool fromTheEnd, double room, double length) {
    if (align == Align::Center)
        return 0.5 * (room - length);
    return (align == Align::End) != fromTheEnd ? room - length : 0;
}

}  // namespace

Typesetter::Typesetter(FontMaps& font, double width, double height, Color ground) {
    require(isPositive(width) && isPositive(height), "typesetter: a page's sides must be positive");
    impl_ = std::make_unique<Impl>(*font.impl_, width, height, ground);
}
Typesetter::~Typesetter() = default;

std::size_t Typesetter::add(std::u32string_view text, const TextBox& box, const TextStyle& style) {
    check(box, style);
    const double size = style.size, room = (style.vertical ? box.height : box.width) / size,
                 across = (style.vertical ? box.width : box.height) / size;
    const text::FontMetrics& metrics = impl_->font.font->metrics();
    const double ascent = metrics.ascent / impl_->font.em(), descent = metrics.descent / impl_->font.em();
    // A vertical line is as wide as high letters lying on their sides.
    const double before = style.vertical ? 0.5 * (ascent + descent) : ascent,
                 after = style.vertical ? before : descent;
    constexpr double rounding = 1e-9;
    double baseline = before;
    const auto isFull = [&] { return baseline + after > across + rounding; };
    std::size_t set = 0;
    while (set < text.size() && !isFull()) {
        const std::u32string_view paragraph = text.substr(set, paragraphEnd(text.substr(set)));
        const std::vector<bool> breaks = text::lineBreaks(std::u32string(paragraph), style.language);
        const std::vector<double> advances = impl_->advancesOf(paragraph, style);
        std::size_t first = 0;
        for (; first < paragraph.size() && !isFull(); baseline += style.lineHeight) {
            limits::check();
            const std::size_t end = lineEnd(paragraph, first, breaks, advances, room);
            double length = 0;
            const std::vector<LineGlyph> glyphs =
                impl_->glyphsOf(withoutBlanksAtEnd(paragraph.substr(first, end - first)), style, length);
            const double along = startOf(style.align, style.rightToLeft && !style.vertical, room, length);
            const dvec2 start = style.vertical ? dvec2(across - baseline, along) : dvec2(along, baseline);
            impl_->place(glyphs, dvec2(box.x, box.y) + start * size, style);
            first = end;
        }
        set += first;
    }
    return set;
}

TextPage Typesetter::page() const { return impl_->page; }

// ---- Cells --------------------------------------------------------------------------------------------

namespace {

/// The first parts of glyphs, then, since a cell names its symbol in a byte, all the others.
class CellSymbols {
public:
    /// `box`: of a cell, from a glyph's origin, ems.
    CellSymbols(GlyphMaps& font, double size, const geometry::Box& box)
        : font_(font), size_(size), box_(box), first_{PageSymbol{}} {}

    std::uint8_t of(GlyphId glyph, bool isClipped) {
        const auto [known, isNew] = known_.try_emplace({glyph, isClipped}, std::uint8_t(0));
        if (isNew)
            known->second = add(isClipped ? font_.clippedPartsOf(glyph, box_) : font_.partsOf(glyph));
        return known->second;
    }

    std::vector<PageSymbol> take() {
        std::vector<PageSymbol> symbols = std::move(first_);
        const std::size_t firsts = symbols.size();
        for (std::size_t i = 1; i < firsts; ++i) {
            std::size_t last = i;
            for (PageSymbol& symbol : more_[i]) {
                symbols[last].next = std::uint16_t(symbols.size());
                last = symbols.size();
                symbols.push_back(symbol);
            }
        }
        return symbols;
    }

private:
    std::uint8_t add(const std::vector<asset::GlyphPart>& parts) {
        if (parts.empty())
            return 0;
        if (first_.size() == maxCellSymbols)
            throw LimitError("a page of cells has at most 255 different glyphs");
        const auto symbolOf = [&](const asset::GlyphPart& part) {
            PageSymbol symbol;
            symbol.map = part.map;
            symbol.linear = glm::dmat2(size_);
            symbol.offset = dvec2(part.x, part.y) * size_;
            return symbol;
        };
        for (std::size_t i = 1; i < parts.size(); ++i)
            more_[first_.size()].push_back(symbolOf(parts[i]));
        first_.push_back(symbolOf(parts.front()));
        return std::uint8_t(first_.size() - 1);
    }

    GlyphMaps& font_;
    const double size_;
    const geometry::Box box_;
    std::map<std::pair<GlyphId, bool>, std::uint8_t> known_;
    std::vector<PageSymbol> first_;
    std::map<std::size_t, std::vector<PageSymbol>> more_;
};

/// Which cells' glyphs touch one in a cell beside, as the lines of boxes do. They end with their cells then.
std::vector<bool> touchingCells(const std::vector<std::optional<GlyphId>>& glyphs, std::size_t columns,
                                dvec2 step, Contacts& contacts) {
    std::vector<bool> result(glyphs.size(), false);
    for (std::size_t i = 0; i < glyphs.size(); ++i)
        for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 1}, {0, 1}, {1, 1}}) {
            const std::ptrdiff_t x = std::ptrdiff_t(i % columns) + dx;
            const std::size_t beside = i + std::size_t(dy) * columns + std::size_t(dx);
            if (x < 0 || x >= std::ptrdiff_t(columns) || beside >= glyphs.size() || !glyphs[i] ||
                !glyphs[beside])
                continue;
            if (contacts.touch(*glyphs[i], *glyphs[beside], dvec2(dx, dy) * step))
                result[i] = result[beside] = true;
        }
    return result;
}

}  // namespace

TextPage Typesetter::cells(FontMaps& maps, const CellText& text) {
    constexpr unsigned maxCells = 65536;
    require(text.columns > 0 && text.rows > 0 && text.columns <= maxCells && text.rows <= maxCells,
            "typesetter: columns and rows must be in [1, 65536]");
    require(isPositive(text.size), "typesetter: sizes must be positive");
    const std::size_t count = std::size_t(text.columns) * text.rows;
    require(text.text.size() <= count, "typesetter: more characters than cells");
    require(text.colors.empty() || text.colors.size() == count, "typesetter: colours must be one a cell");
    require(!text.palette.empty(), "typesetter: the palette is empty");
    GlyphMaps& font = *maps.impl_;
    const double width = maps.advanceOf(U'0').value_or(maps.advanceOf(U' ').value_or(0.5));
    asset::PageCells cells;
    cells.columns = text.columns;
    cells.rows = text.rows;
    cells.size = dvec2(width, maps.ascent() + maps.descent()) * text.size;
    cells.origin = dvec2(0, maps.ascent() * text.size);
    require(isPositive(cells.size.x) && isPositive(cells.size.y),
            "typesetter: the font's characters have no size");
    TextPage page;
    page.width = cells.size.x * text.columns;
    page.height = cells.size.y * text.rows;
    page.ground = text.ground;
    std::vector<std::optional<GlyphId>> glyphs(count);
    for (std::size_t i = 0; i < text.text.size(); ++i)
        if (text.text[i] != U' ')
            glyphs[i] = font.font->glyphOf(text.text[i]).value_or(0);
    Contacts contacts(font);
    const std::vector<bool> touching = touchingCells(glyphs, text.columns, cells.size / text.size, contacts);
    CellSymbols symbols(font, text.size, {{0, -maps.ascent()}, {width, maps.descent()}});
    cells.symbols.resize(count, 0);
    for (std::size_t i = 0; i < count; ++i)
        if (glyphs[i])
            cells.symbols[i] = symbols.of(*glyphs[i], touching[i]);
    page.symbols = symbols.take();
    cells.colors = text.colors;
    cells.palette = text.palette;
    if (text.colors.empty())
        for (PageSymbol& symbol : page.symbols)
            symbol.color = text.palette.front();
    page.cells = std::move(cells);
    return page;
}

}  // namespace vtm::font

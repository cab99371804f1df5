// Text: glyphs as shapes. Source: SVG 2 chapter 11.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/place.hpp"
#include "svg/convert/converter.hpp"
#include "svg/css/font_values.hpp"
#include "svg/text/element_font.hpp"
#include "svg/text/layout.hpp"

namespace vtm::svg {
namespace {

using scene::Path;

void append(Path& path, const Path& more) { path.insert(path.end(), more.begin(), more.end()); }

/// The box round the clusters' cells: what gradients on text refer to (SVG 2 section 8.10).
Path cellsOf(const TextLayout& layout) {
    Path cells;
    for (const PlacedCluster& cluster : layout.clusters) {
        const Box& c = cluster.cell;
        std::vector<scene::Point> corners;
        for (const scene::Point corner :
             {c.min, scene::Point(c.max.x, c.min.y), c.max, scene::Point(c.min.x, c.max.y)})
            corners.push_back(scene::apply(cluster.frame, corner));
        append(cells, scene::polygon(corners));
    }
    return cells;
}

bool isPlain(PaintKind kind) { return kind == PaintKind::Color || kind == PaintKind::CurrentColor; }

}  // namespace

text::FontSet& Converter::fonts() {
    if (!fonts_)
        addFontFaces(*(fonts_ = std::make_unique<text::FontSet>(options_.fonts)));
    return *fonts_;
}

void Converter::warnOfMissingFamilies(const TextContent& content) {
    for (const TextElement& element : content.elements) {
        const std::vector<std::string> families = familiesIn(element.scope.style.fontFamily);
        const bool found =
            families.empty() || std::any_of(families.begin(), families.end(),
                                            [&](const auto& family) { return fonts().hasFamily(family); });
        if (found || !missingFamilies_.insert(families.front()).second)
            continue;
        const auto used = fonts().primary(fontQuery(element));
        reporter_.warn(Kind::Font, *element.element,
                       fmt::format("there is no font of the family \"{}\"; \"{}\" is used", families.front(),
                                   used ? used->family() : ""));
    }
}

/// One warning for the characters of a text that no font has.
void Converter::warnOfMissingGlyphs(const Element& element, const TextContent& content,
                                    const TextLayout& layout) {
    std::set<char32_t> missing;
    for (const PlacedCluster& cluster : layout.clusters)
        for (const PlacedGlyph& glyph : cluster.glyphs)
            if (glyph.id == 0)
                missing.insert(content.characters[cluster.first].code);
    if (missing.empty())
        return;
    std::string others;
    if (missing.size() > 1)
        others = fmt::format(" and {} {}", missing.size() - 1, missing.size() > 2 ? "others" : "other");
    reporter_.warn(Kind::Font, element,
                   fmt::format("no font has the character U+{:04X}{}",
                               static_cast<std::uint32_t>(*missing.begin()), others));
}

void Converter::convertText(const Element& element, const Scope& scope, Nodes& out) {
    paintText(element, scope, textContent(element, scope), out);
}

/// Inkscape's text in a frame, which no published SVG has.
void Converter::convertFlowRoot(const Element& element, const Scope& scope, Nodes& out) {
    reporter_.warn(Kind::Element, element, "is not part of SVG; its text is drawn in lines as Inkscape does");
    paintText(element, scope, flowContent(element, scope), out);
}

/// Nothing where nothing is to be drawn; says why.
std::optional<Converter::PlacedText> Converter::placeText(const Element& element, const Scope& scope,
                                                          const TextContent& content) {
    if (content.characters.empty())
        return std::nullopt;
    if (!fonts().primary({})) {
        reporter_.warn(Kind::Font, element, "there are no fonts; it is left out");
        return std::nullopt;
    }
    warnOfMissingFamilies(content);
    PlacedText text{layOut(content, fonts()), {}, {}};
    if (text.layout.clusters.empty())
        return std::nullopt;
    warnOfMissingGlyphs(element, content, text.layout);
    text.cells = std::make_shared<const Path>(cellsOf(text.layout));
    text.box = boundingBox(*text.cells, scene::identity);
    if (!isWithinReach(geometry::mapped(text.box, scope.transform))) {
        reporter_.warn(Kind::Limit, element, "lies too far away; it is left out");
        return std::nullopt;
    }
    return text;
}

void Converter::paintText(const Element& element, const Scope& scope, const TextContent& content,
                          Nodes& out) {
    const std::optional<PlacedText> text = placeText(element, scope, content);
    if (!text)
        return;
    const TextLayout& layout = text->layout;
    const Box& box = text->box;
    if (outlineListeners_ > 0)
        outlines_.push_back({text->cells, scope.transform});
    const auto drawLines = [&](bool through) {
        for (const PlacedLine& line : layout.lines)
            if ((line.line == LineThrough) == through)
                paintLine(content, line, box, out);
    };
    drawLines(false);
    for (std::size_t first = 0, end = 0; first < layout.clusters.size(); first = end) {
        while (end < layout.clusters.size() && layout.clusters[end].element == layout.clusters[first].element)
            ++end;
        paintClusters(content.elements[static_cast<std::size_t>(layout.clusters[first].element)],
                      std::span(layout.clusters).subspan(first, end - first), box, out);
    }
    drawLines(true);
}

/// With the fill and stroke of the element whose line it is.
void Converter::paintLine(const TextContent& content, const PlacedLine& line, const Box& box, Nodes& out) {
    const Scope& scope = content.elements[line.element].scope;
    const Element& element = *content.elements[line.element].element;
    if (!scope.style.visible)
        return;
    CachedShape shape{{}, 0, std::make_shared<const Path>(line.outline), box, {}};
    for (const PaintStage stage : scope.style.paintOrder)
        if (stage == PaintStage::Fill)
            fillShape(element, scope, shape, out);
        else if (stage == PaintStage::Stroke)
            strokeShape(element, scope, shape, out);
}

void Converter::paintClusters(const TextElement& text, std::span<const PlacedCluster> clusters,
                              const Box& box, Nodes& out) {
    if (!text.scope.style.visible)
        return;
    const Style& style = text.scope.style;
    Path merged;  // all outlines, in the user space of the text
    const bool mergesFill = !isPlain(style.fill.kind), strokes = style.stroke.kind != PaintKind::None;
    Nodes colored;
    std::vector<std::pair<const PlacedGlyph*, std::shared_ptr<const Path>>> plain;
    for (const PlacedCluster& cluster : clusters)
        for (const PlacedGlyph& glyph : cluster.glyphs) {
            if (paintColorGlyph(text, glyph, colored))
                continue;
            const auto outline = glyph.font->outlineOf(glyph.id);
            if (!outline)
                continue;
            plain.emplace_back(&glyph, outline);
            if (mergesFill || strokes)
                append(merged, mapPath(glyph.transform, *outline));
        }
    CachedShape shape{{}, 0, std::make_shared<const Path>(std::move(merged)), box, {}};
    for (const PaintStage stage : style.paintOrder)
        if (stage == PaintStage::Fill && !mergesFill)
            for (const auto& [glyph, outline] : plain)
                fillGlyph(text, *glyph, outline, out);
        else if (stage == PaintStage::Fill && !shape.path->empty())
            fillShape(*text.element, text.scope, shape, out);
        else if (stage == PaintStage::Stroke && !shape.path->empty())
            strokeShape(*text.element, text.scope, shape, out);
    out.insert(out.end(), std::make_move_iterator(colored.begin()), std::make_move_iterator(colored.end()));
}

/// With a colour: the outline is shared by all instances of the glyph.
void Converter::fillGlyph(const TextElement& text, const PlacedGlyph& glyph,
                          const std::shared_ptr<const Path>& outline, Nodes& out) {
    const Style& style = text.scope.style;
    scene::Item item;
    item.path = outline;
    item.transform = scene::compose(text.scope.transform, glyph.transform);
    if (style.fillOpacity <= 0 || !scene::inverse(item.transform))
        return;
    item.geometry = scene::FillRule::NonZero;
    item.paint = style.fill.kind == PaintKind::CurrentColor ? style.color : style.fill.color;
    item.opacity = static_cast<float>(style.fillOpacity);
    item.place = placeOf(*text.element);
    item.place.character = static_cast<std::uint32_t>(glyph.character + 1);
    out.push_back({std::move(item)});
}

/// False for glyphs without colours of their own.
bool Converter::paintColorGlyph(const TextElement& text, const PlacedGlyph& glyph, Nodes& out) {
    const Style& style = text.scope.style;
    auto colored = glyph.font->colorGlyphOf(glyph.id, style.color);
    const scene::Affine transform = scene::compose(text.scope.transform, glyph.transform);
    if (!colored || !scene::inverse(transform))
        return colored.has_value();
    scene::Group group;
    if (auto* made = std::get_if<scene::Group>(&*colored))
        group = scene::placed(std::move(*made), transform);
    else
        convertSvgGlyph(text, glyph, std::get<text::SvgGlyph>(*colored), transform, group.children);
    group.opacity = static_cast<float>(style.fillOpacity);
    appendGroup(std::move(group), true, out);
    return true;
}

void Converter::addClipText(const Element& element, const Scope& parent, scene::Clip& clip) {
    const std::optional<Scope> scope = spend() ? enter(element, parent) : std::nullopt;
    if (!scope)
        return;
    const TextContent content = textContent(element, *scope);
    const std::optional<PlacedText> text = placeText(element, *scope, content);
    if (!text)
        return;
    const auto own = clipOf(element, *scope, text->box);
    const limits::Place place = placeOf(element);
    const auto add = [&](std::shared_ptr<const Path> path, const scene::Affine& transform) {
        if (path && scene::inverse(transform))
            clip.shapes.push_back({std::move(path), transform, scene::FillRule::NonZero, own, place});
    };
    for (const PlacedCluster& cluster : text->layout.clusters)
        if (content.elements[static_cast<std::size_t>(cluster.element)].scope.style.visible)
            for (const PlacedGlyph& glyph : cluster.glyphs)
                add(glyph.font->outlineOf(glyph.id), scene::compose(scope->transform, glyph.transform));
    for (const PlacedLine& line : text->layout.lines)
        add(std::make_shared<const Path>(line.outline), scope->transform);
}

}  // namespace vtm::svg

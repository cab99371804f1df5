// The content of a `text` element: what it and the elements in it say. Source: SVG 2 sections 11.2 and 11.4.

#include "svg/convert/converter.hpp"
#include "svg/geometry/path_data.hpp"
#include "svg/text/content.hpp"
#include "svg/text/element_font.hpp"
#include "svg/text/flow.hpp"

namespace vtm::svg {
namespace {

/// The nearest of the attributes on the element or around it.
std::string_view inheritedAttribute(const Element& element, std::initializer_list<std::string_view> names) {
    for (const Element* e = &element; e; e = e->parent)
        for (const std::string_view name : names)
            if (const auto value = e->find(name))
                return trim(*value);
    return {};
}

bool isTextContent(Tag tag) {
    return tag == Tag::Tspan || tag == Tag::A || tag == Tag::Tref || tag == Tag::TextPath ||
           tag == Tag::FlowPara || tag == Tag::FlowSpan;
}

/// Whether it may stand in an element of that tag: paths and references do not stand in each other.
bool mayStandIn(Tag inner, Tag outer) {
    if (outer == Tag::Tref)
        return false;
    return inner != Tag::TextPath || outer == Tag::Text || outer == Tag::A;
}

/// Numbers with optional commas between them, up to what is none.
std::vector<double> readLengths(std::string_view text, Axis axis, const Viewport& viewport,
                                const Units& units) {
    std::vector<double> lengths;
    Cursor cursor(trim(text));
    while (const auto length = readLength(cursor, units)) {
        lengths.push_back(resolve(*length, axis, viewport));
        cursor.skipCommaSpaces();
    }
    return lengths;
}

std::vector<double> readAngles(std::string_view text) {
    std::vector<double> angles;
    Cursor cursor(trim(text));
    while (const auto angle = cursor.number()) {
        angles.push_back(*angle);
        cursor.skipCommaSpaces();
    }
    return cursor.atEnd() ? angles : std::vector<double>{};
}

}  // namespace

class Converter::TextCollector {
public:
    explicit TextCollector(Converter& converter) : converter_(converter) {}

    /// The paragraphs too, where there are any.
    TextContent collect(const Element& text, const Scope& scope, std::vector<Paragraph>& paragraphs) {
        visit(text, scope, -1, -1);
        const std::vector<bool> kept = keptCharacters(raw_);
        std::vector<std::size_t> index;  // of the first kept character from a raw one on
        for (std::size_t i = 0; i < raw_.size(); ++i) {
            index.push_back(content_.characters.size());
            if (kept[i])
                content_.characters.push_back({raw_[i].code, raw_[i].element, {}, {}});
        }
        index.push_back(content_.characters.size());
        for (const Extent& extent : extents_) {
            position(extent, index);
            if (at(extent.element).element->tag == Tag::FlowPara)
                paragraphs.push_back({index[extent.first], extent.element});
        }
        keepMarksWithTheirBases();
        if (!content_.characters.empty())
            makeSmallCaps(content_, converter_.fonts());
        return std::move(content_);
    }

private:
    /// The raw characters of an element and of those in it.
    struct Extent {
        int element;
        std::size_t first, end;
    };

    TextElement& at(int element) { return content_.elements[static_cast<std::size_t>(element)]; }

    /// The style of a text content element; nothing where it is not rendered.
    std::optional<Scope> enter(const Element& element, const Scope& around) const {
        if (!converter_.passesConditions(element))
            return std::nullopt;
        Scope scope = around;
        scope.style = computeStyle(element, around.style, converter_.unitsFor(around.style));
        ++scope.depth;
        return scope.style.displayed ? std::optional(std::move(scope)) : std::nullopt;
    }

    void visit(const Element& element, const Scope& scope, int parent, int path) {
        if (!converter_.spend())
            return;
        const Level level(converter_, element);
        if (!level)
            return;
        const int index = static_cast<int>(content_.elements.size());
        content_.elements.push_back(textElement(element, scope, parent, path));
        const std::size_t extent = extents_.size();
        extents_.push_back({index, raw_.size(), 0});
        if (element.tag == Tag::Tref)
            appendReferenced(element, index);
        for (const Element* child : element.children)
            visitChild(*child, element, scope, index, path);
        extents_[extent].end = raw_.size();
    }

    void visitChild(const Element& child, const Element& parent, const Scope& scope, int index, int path) {
        if (child.tag == Tag::CharacterData && parent.tag != Tag::Tref && parent.tag != Tag::FlowRoot)
            return appendText(child.text, index);
        if (!isTextContent(child.tag) || !mayStandIn(child.tag, parent.tag))
            return;
        const std::optional<Scope> inner = enter(child, scope);
        if (!inner)
            return;
        if (child.tag == Tag::TextPath && !addPath(child, *inner))
            return separate(child, index);
        visit(child, *inner, index,
              child.tag == Tag::TextPath ? static_cast<int>(content_.paths.size()) - 1 : path);
    }

    /// The characters of an element that is not rendered still part the white space around them.
    void separate(const Element& element, int index) {
        for (const Element* child : element.children)
            if (child->tag == Tag::CharacterData)
                appendText(child->text, index, false);
    }

    TextElement textElement(const Element& element, const Scope& scope, int parent, int path) const {
        TextElement made;
        made.element = &element;
        made.scope = scope;
        made.parent = parent;
        made.path = path;
        made.language = inheritedAttribute(element, {"xml:lang", "lang"});
        if (made.language.empty())
            made.language = converter_.options_.language;
        const Style& style = scope.style;
        made.lines = style.textLines;
        made.decoration = style.decoration;
        for (const Element* e = parent < 0 ? element.parent : nullptr; e; e = e->parent) {
            const Style& around = converter_.styleOf(*e);
            if (made.lines == 0)
                made.decoration = around.decoration;
            made.lines |= around.textLines;
        }
        made.letterSpacing = resolve(style.letterSpacing, Axis::X, scope.viewport);
        made.wordSpacing = resolve(style.wordSpacing, Axis::X, scope.viewport);
        const auto length = converter_.lengths(element, scope).length("textLength", Axis::X);
        if (length && *length >= 0)
            made.textLength = length;
        made.stretchesGlyphs = trim(element.get("lengthAdjust")) == "spacingAndGlyphs";
        return made;
    }

    void appendText(std::string_view text, int index, bool rendered = true) {
        const TextElement& element = at(index);
        const bool preserve = inheritedAttribute(*element.element, {"xml:space"}) == "preserve";
        appendCharacters(
            text, index,
            element.scope.style.whiteSpace.value_or(preserve ? WhiteSpace::Preserve : WhiteSpace::Collapse),
            rendered, raw_);
    }

    /// All characters in the element that a `tref` names.
    void appendReferenced(const Element& tref, int index) {
        const Element* target = converter_.tree_.byHref(hrefOf(tref).value_or(std::string_view{}));
        if (!target || target->tag == Tag::Unknown || target->tag == Tag::Foreign)
            return converter_.reporter_.warn(Kind::Reference, tref, "does not refer to an element of SVG");
        appendCharactersIn(*target, index);
    }

    void appendCharactersIn(const Element& element, int index) {
        for (const Element* child : element.children)
            if (child->tag == Tag::CharacterData)
                appendText(child->text, index);
            else if (converter_.spend())
                appendCharactersIn(*child, index);
    }

    /// Adds the path that a `textPath` follows; false, after a warning, where there is none.
    bool addPath(const Element& element, const Scope& scope) {
        const auto path = pathOf(element, scope);
        if (!path)
            return false;
        TextPath made{PathMeasure(*path)};
        made.right = trim(element.get("side")) == "right";
        const auto offset = parseLength(element.get("startOffset"), converter_.unitsFor(scope.style));
        if (offset && offset->percent)
            made.startOffset = offset->of(made.measure.length());
        else if (offset)
            made.startOffset = offset->value * lengthScale(element, made.measure.length());
        content_.paths.push_back(std::move(made));
        return true;
    }

    /// `pathLength` of the referenced path gives the unit of startOffset.
    double lengthScale(const Element& textPath, double length) const {
        const Element* target = converter_.tree_.byHref(hrefOf(textPath).value_or(std::string_view{}));
        Cursor cursor(target ? trim(target->get("pathLength")) : std::string_view{});
        const auto given = cursor.number();
        return given && *given > 0 ? length / *given : 1;
    }

    /// In the user space of the text: the path's own transform counts, those around it do not.
    std::optional<scene::Path> pathOf(const Element& element, const Scope& scope) const {
        if (const auto data = element.find("path"))
            return parsePathData(*data).path;
        const Element* target = converter_.tree_.byHref(hrefOf(element).value_or(std::string_view{}));
        if (!target || !isShape(target->tag)) {
            converter_.reporter_.warn(Kind::Reference, element,
                                      "does not refer to a path; its text is left out");
            return std::nullopt;
        }
        const CachedShape* shape = converter_.shapeOf(*target, scope);
        if (!shape)
            return std::nullopt;
        const Style& style = converter_.styleOf(*target);
        return mapPath(converter_.transformFrom(style.transform, style, scope.viewport), *shape->path);
    }

    /// The lists of one element, on the characters in it. Those of elements in it replace them later.
    void position(const Extent& extent, const std::vector<std::size_t>& index) {
        const TextElement& text = at(extent.element);
        const std::size_t first = index[extent.first], count = index[extent.end] - first;
        if (text.element->tag == Tag::TextPath || text.element->tag == Tag::A)
            return;
        const Units units = converter_.unitsFor(text.scope.style);
        const auto lengths = [&](std::string_view name, Axis axis) {
            return readLengths(text.element->get(name), axis, text.scope.viewport, units);
        };
        const auto x = lengths("x", Axis::X), y = lengths("y", Axis::Y), dx = lengths("dx", Axis::X),
                   dy = lengths("dy", Axis::Y), rotate = readAngles(text.element->get("rotate"));
        for (std::size_t i = 0; i < count; ++i) {
            TextCharacter& character = content_.characters[first + i];
            if (i < x.size())
                character.x = x[i];
            if (i < y.size())
                character.y = y[i];
            character.dx = i < dx.size() ? dx[i] : character.dx;
            character.dy = i < dy.size() ? dy[i] : character.dy;
            if (!rotate.empty())
                character.rotate = rotate[std::min(i, rotate.size() - 1)];
        }
    }

    /// The absolute position of a mark is the next character's, unless that has one. Source: SVG 2 section
    /// 11.5, "Adjust positions: x, y".
    void keepMarksWithTheirBases() {
        std::vector<TextCharacter>& characters = content_.characters;
        for (std::size_t i = 1; i < characters.size(); ++i) {
            TextCharacter& mark = characters[i];
            if (!text::isMark(mark.code))
                continue;
            if (i + 1 < characters.size()) {
                TextCharacter& next = characters[i + 1];
                next.x = next.x ? next.x : mark.x;
                next.y = next.y ? next.y : mark.y;
            }
            mark.x = mark.y = std::nullopt;
        }
    }

    Converter& converter_;
    TextContent content_;
    std::vector<RawCharacter> raw_;
    std::vector<Extent> extents_;
};

TextContent Converter::textContent(const Element& text, const Scope& scope) {
    std::vector<Paragraph> paragraphs;
    TextContent content = TextCollector(*this).collect(text, scope, paragraphs);
    const std::optional<Length> inlineSize = scope.style.inlineSize;
    const double width = inlineSize ? resolve(*inlineSize, Axis::X, scope.viewport) : 0;
    if (!(width > 0) || content.characters.empty() || scope.style.writingMode != WritingMode::Horizontal)
        return content;
    // SVG 2 section 11.7.3: only the first position counts.
    const double x = content.characters.front().x.value_or(0), y = content.characters.front().y.value_or(0);
    for (TextCharacter& character : content.characters)
        character.x = character.y = std::nullopt;
    flow(content, {{0, 0}}, {x, y - firstAscent(content, fonts()), width}, fonts());
    return content;
}

/// The box of the first `flowRegion`, in user space.
Box Converter::flowRegion(const Element& flowRoot, const Scope& scope) {
    for (const Element* region : flowRoot.children)
        if (region->tag == Tag::FlowRegion) {
            Box box;
            for (const Element* child : region->children)
                if (const CachedShape* shape = isShape(child->tag) ? shapeOf(*child, scope) : nullptr) {
                    const Style& style = styleOf(*child);
                    box.add(boundingBox(*shape->path, transformFrom(style.transform, style, scope.viewport)));
                }
            return box;
        }
    return {};
}

TextContent Converter::flowContent(const Element& flowRoot, const Scope& scope) {
    std::vector<Paragraph> paragraphs;
    TextContent content = TextCollector(*this).collect(flowRoot, scope, paragraphs);
    const Box box = flowRegion(flowRoot, scope);
    if (box.empty() || paragraphs.empty())
        return {};
    for (TextElement& element : content.elements)
        element.scope.style.anchor = scope.style.align;
    const double share = scope.style.align == TextAnchor::Start    ? 0
                         : scope.style.align == TextAnchor::Middle ? .5
                                                                   : 1;
    flow(content, paragraphs, {box.min.x + share * box.width(), box.min.y, box.width(), box.max.y}, fonts());
    return content;
}

}  // namespace vtm::svg

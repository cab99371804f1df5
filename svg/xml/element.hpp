/// \file
/// The document as a tree of elements: names and namespaces resolved, CSS declarations attached,
/// nothing inherited or referenced yet (both depend on where a `use` places an element).
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace vtm::svg {

struct Property;

enum class Tag : unsigned char {
    Unknown,        ///< an SVG name that we do not know
    Foreign,        ///< an element of another namespace
    CharacterData,  ///< not an element: text between tags
    A,
    Animation,
    Circle,
    ClipPath,
    Cursor,
    Defs,
    Descriptive,
    Ellipse,
    Filter,
    FilterPrimitive,
    FlowPara,  ///< flowPara, flowDiv, flowLine of SVG 1.2's draft, which Inkscape wrote
    FlowRegion,
    FlowRoot,
    FlowSpan,
    ForeignObject,
    G,
    Image,
    Line,
    LinearGradient,
    Marker,
    Mask,
    Path,
    Pattern,
    Polygon,
    Polyline,
    RadialGradient,
    Rect,
    Script,
    Stop,
    Style,
    Svg,
    Switch,
    Symbol,
    Text,
    TextPath,
    Tref,
    Tspan,
    Use,
    View
};

Tag tagOf(std::string_view localName);
/// The name of elements of that tag that are drawn or lead to what is; empty for others. Static storage.
const char* nameOf(Tag tag);

/// Names are local for attributes without a namespace; `xlink:` and `xml:` stand for those
/// namespaces whatever prefix the file gives them.
struct Attribute {
    std::string_view name, value;
};

/// A property's value, winner or not, as the cascade sorted it.
struct Declaration {
    const Property* property;
    std::string_view value;
};

struct Element {
    Tag tag = Tag::Unknown;
    std::string_view name;                                            ///< local name
    std::string_view text;                                            ///< of CharacterData
    Element *parent = nullptr, *previous = nullptr, *next = nullptr;  ///< siblings that are elements
    std::vector<Element*> children;
    std::vector<Attribute> attributes;
    std::vector<Declaration> declarations;  ///< weakest first: a later valid one replaces it
    std::size_t offset = 0;                 ///< of its name in the text that was parsed
    bool hasText = false;                   ///< characters, also where the tree does not keep them

    std::optional<std::string_view> find(std::string_view attribute) const;
    /// Empty where the attribute is absent.
    std::string_view get(std::string_view attribute) const {
        return find(attribute).value_or(std::string_view{});
    }
};

/// The fragment that `href` or else `xlink:href` names.
std::optional<std::string_view> hrefOf(const Element& element);

/// A rule `@font-face` in a style sheet.
struct FontFaceRule {
    const Element* sheet = nullptr;
    std::string directory;  ///< where the references of its sheet start
    std::vector<Attribute> descriptors;
};

/// Owns the elements and the text that their string_views point into.
struct Tree {
    std::string text;
    std::deque<std::string> ownedText;  ///< what had to be rewritten, such as CSS without its comments
    std::deque<Element> elements;
    std::vector<FontFaceRule> fontFaces;
    std::vector<std::string_view> styleSheets;  ///< `<?xml-stylesheet …?>`, what stands in each
    Element* root = nullptr;
    std::unordered_map<std::string_view, Element*> ids;  ///< the first element of each id

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;

    const Element* byId(std::string_view id) const;
    /// What a local reference `#id` names, null if nothing or if it is not local.
    const Element* byHref(std::string_view href) const;
};

}  // namespace vtm::svg

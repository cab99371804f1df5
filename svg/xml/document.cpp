#include "svg/xml/document.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <pugixml.hpp>

#include <memory>

#include <vtm/limits/limits.hpp>
#include "svg/convert/converter.hpp"
#include "svg/css/attributes.hpp"
#include "svg/css/cascade.hpp"
#include "svg/css/cursor.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/xml/decode.hpp"
#include "svg/xml/element.hpp"
#include "svg/xml/report.hpp"

namespace vtm::svg {

// ---- XML text to the tree of elements -----------------------------------------------------------

namespace {

constexpr std::string_view svgNamespace = "http://www.w3.org/2000/svg";
constexpr std::string_view xlinkNamespace = "http://www.w3.org/1999/xlink";

struct QualifiedName {
    std::string_view prefix, local;
};

QualifiedName split(std::string_view name) {
    const std::size_t colon = name.find(':');
    if (colon == name.npos)
        return {{}, name};
    return {name.substr(0, colon), name.substr(colon + 1)};
}

/// The namespaces in force: a stack of prefix and URI, innermost last.
class Namespaces {
public:
    std::size_t depth() const { return bindings_.size(); }
    void restore(std::size_t depth) { bindings_.resize(depth); }

    void declare(const pugi::xml_node& node) {
        for (const pugi::xml_attribute& attribute : node.attributes()) {
            const QualifiedName name = split(attribute.name());
            if (name.prefix == "xmlns")
                bindings_.push_back({name.local, trim(attribute.value())});
            else if (name.prefix.empty() && name.local == "xmlns")
                bindings_.push_back({{}, trim(attribute.value())});
        }
    }
    /// Nothing if the prefix was never declared.
    std::optional<std::string_view> uri(std::string_view prefix) const {
        for (auto binding = bindings_.rbegin(); binding != bindings_.rend(); ++binding)
            if (binding->prefix == prefix)
                return binding->uri;
        return std::nullopt;
    }

private:
    struct Binding {
        std::string_view prefix, uri;
    };
    std::vector<Binding> bindings_;
};

/// Elements whose text may be drawn or read. A `tref` may name any other.
bool keepsText(const Element& element) {
    for (const Element* e = &element; e; e = e->parent)
        if (e->tag == Tag::Text || e->tag == Tag::FlowRoot || e->tag == Tag::Style || e->tag == Tag::Tref)
            return true;
    return false;
}

class Builder {
public:
    Builder(Tree& tree, const SourceMap& map, bool keepsAllText)
        : tree_(tree), map_(map), keepsAllText_(keepsAllText) {}

    Element* build(const pugi::xml_node& node, Element* parent, int depth) {
        limits::check();
        if (depth > Limits::maxDepth)
            throw ParseError(map_.at(offsetOf(node)), "elements are nested too deep");
        const std::size_t scope = namespaces_.depth();
        namespaces_.declare(node);
        Element& element = tree_.elements.emplace_back();
        element.parent = parent;
        element.offset = offsetOf(node);
        name(element, node);
        attributes(element, node);
        children(element, node, depth);
        namespaces_.restore(scope);
        return &element;
    }

private:
    static std::size_t offsetOf(const pugi::xml_node& node) {
        return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    }

    /// Files without any declaration are taken for SVG: their authors meant it.
    void name(Element& element, const pugi::xml_node& node) const {
        const QualifiedName name = split(node.name());
        element.name = name.local;
        const std::optional<std::string_view> uri = namespaces_.uri(name.prefix);
        const bool svg = uri ? *uri == svgNamespace : name.prefix.empty() || name.prefix == "svg";
        element.tag = svg ? tagOf(name.local) : Tag::Foreign;
    }

    void attributes(Element& element, const pugi::xml_node& node) {
        for (const pugi::xml_attribute& attribute : node.attributes()) {
            const QualifiedName name = split(attribute.name());
            if (name.prefix.empty())
                element.attributes.push_back({name.local, attribute.value()});
            else if (name.prefix == "xml")
                element.attributes.push_back({attribute.name(), attribute.value()});
            else if (name.local == "href" && isXlink(name.prefix))
                element.attributes.push_back({"xlink:href", attribute.value()});
        }
        if (const auto id = element.find("id"); id && !id->empty())
            tree_.ids.try_emplace(*id, &element);
    }

    bool isXlink(std::string_view prefix) const {
        return namespaces_.uri(prefix).value_or(prefix == "xlink" ? xlinkNamespace : "") == xlinkNamespace;
    }

    void children(Element& element, const pugi::xml_node& node, int depth) {
        Element* previous = nullptr;
        const bool text = keepsAllText_ || keepsText(element);
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_element) {
                Element* built = build(child, &element, depth + 1);
                built->previous = previous;
                if (previous)
                    previous->next = built;
                previous = built;
                element.children.push_back(built);
            } else if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) {
                continue;
            } else if (element.hasText = true; text) {
                Element& data = tree_.elements.emplace_back();
                data.tag = Tag::CharacterData;
                data.text = child.value();
                data.parent = &element;
                data.offset = offsetOf(child);
                element.children.push_back(&data);
            }
        }
    }

    Tree& tree_;
    const SourceMap& map_;
    const bool keepsAllText_;
    Namespaces namespaces_;
};

/// Takes the text over (entities already expanded). Throws ParseError if it is not well formed, has
/// no `svg` root or nests deeper than Limits::maxDepth. Declarations are left empty.
std::unique_ptr<Tree> parseXml(std::string text, const SourceMap& map) {
    const limits::Stage stage("reading the XML");
    limits::need(text.size());
    auto tree = std::make_unique<Tree>();
    tree->text = std::move(text);
    const bool keepsAllText = tree->text.find("tref") != std::string::npos;
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer_inplace(
        tree->text.data(), tree->text.size(), pugi::parse_default | pugi::parse_ws_pcdata | pugi::parse_pi,
        pugi::encoding_utf8);
    if (!result)
        throw ParseError(map.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
                         result.description());
    for (const pugi::xml_node& node : document.children())
        if (node.type() == pugi::node_pi && std::string_view(node.name()) == "xml-stylesheet")
            tree->styleSheets.push_back(node.value());
    const pugi::xml_node root = document.document_element();
    tree->root = Builder(*tree, map, keepsAllText).build(root, nullptr, 1);
    if (tree->root->tag != Tag::Svg)
        throw ParseError(map.at(tree->root->offset), "the root element is not an SVG <svg>");
    return tree;
}

}  // namespace

// ---- The document -------------------------------------------------------------------------------

namespace {

/// Elements that act in browsers, and never here.
void warnOfIgnored(const Tree& tree, Reporter& reporter) {
    for (const Element& element : tree.elements)
        if (element.tag == Tag::Animation)
            reporter.warn(Warning::Kind::Element, element,
                          "animation is ignored; what it changes keeps its base value");
        else if (element.tag == Tag::Script)
            reporter.warn(Warning::Kind::Element, element, "scripts are ignored");
}

/// Largest side of a picture, user units: what doubles resolve to a thousandth with room to spare.
constexpr double maxSide = 1e9;

/// Throws ParseError unless a picture can have such a side.
void checkSide(const ParsedDocument& document, const char* name, double side) {
    const Element& root = *document.tree->root;
    if (!(side >= scene::minSide && side <= maxSide))
        throw ParseError(
            document.map.at(root.offset),
            fmt::format("<svg>: a {} of {} user units cannot be drawn: it must lie in [2^-40, 1e9]", name,
                        side));
}

const Element& exportedElement(const ParsedDocument& document, const std::string& id) {
    if (const Element* element = document.tree->byId(id))
        return *element;
    throw ParseError(document.map.at(document.tree->root->offset),
                     fmt::format("no element has the id \"{}\"", id));
}

/// Of what is drawn within the picture.
std::optional<Rect> shownBounds(const scene::Scene& scene) {
    const Box box = boxAround(scene.root.children);
    const scene::Point min = glm::max(box.min, 0.0),
                       max = glm::min(box.max, scene::Point(scene.width, scene.height));
    if (!(min.x < max.x && min.y < max.y))
        return std::nullopt;
    return Rect{min.x, min.y, max.x - min.x, max.y - min.y};
}

}  // namespace

std::unique_ptr<ParsedDocument> parseDocument(std::span<const std::uint8_t> bytes, const Options& options,
                                              std::vector<Warning>& warnings) {
    auto document = std::make_unique<ParsedDocument>(warnings);
    std::string text = decodeText(bytes, options.fileName);
    document->map = SourceMap(options.fileName, text);
    text = expandEntities(std::move(text), document->map);
    document->tree = parseXml(std::move(text), document->map);
    warnOfIgnored(*document->tree, document->reporter);
    checkAttributes(*document->tree, document->reporter);
    cascade(*document->tree, options, document->reporter);
    return document;
}

Document load(std::span<const std::uint8_t> bytes, const Options& options) {
    Document result;
    const auto document = parseDocument(bytes, options, result.warnings);
    Budget budget;
    Converter converter(*document->tree, document->reporter, options, budget);
    const Viewport size = converter.rootSize();
    checkSide(*document, "width", size.width);
    checkSide(*document, "height", size.height);
    result.scene.width = size.width;
    result.scene.height = size.height;
    if (options.exportId.empty()) {
        converter.convertRoot(scene::identity, result.scene.root.children);
        return result;
    }
    const Element& element = exportedElement(*document, options.exportId);
    converter.convertOnly(element, scene::identity, result.scene.root.children);
    result.exported = shownBounds(result.scene);
    if (!result.exported)
        throw ParseError(document->map.at(element.offset),
                         fmt::format("#{}: the element draws nothing inside the picture", options.exportId));
    return result;
}

}  // namespace vtm::svg

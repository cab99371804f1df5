#include "svg/xml/document.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>

#include "svg/convert/converter.hpp"
#include "svg/css/attributes.hpp"
#include "svg/css/cascade.hpp"
#include "svg/geometry/bounds.hpp"
#include "svg/xml/decode.hpp"
#include "svg/xml/xml.hpp"

namespace vtm::svg {
namespace {

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
    checkAttributes(*document->tree, document->reporter);
    cascade(*document->tree, options.styleSheet, document->reporter);
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

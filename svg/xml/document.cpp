#include "svg/xml/document.hpp"

#include <fmt/format.h>

#include "svg/convert/converter.hpp"
#include "svg/css/attributes.hpp"
#include "svg/css/cascade.hpp"
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

}  // namespace

std::unique_ptr<ParsedDocument> parseDocument(std::span<const std::uint8_t> bytes, const Options& options,
                                              std::vector<Warning>& warnings) {
    auto document = std::make_unique<ParsedDocument>(warnings);
    std::string text = decodeText(bytes, options.fileName);
    document->map = SourceMap(options.fileName, text);
    text = expandEntities(std::move(text), document->map);
    document->tree = parseXml(std::move(text), document->map);
    checkAttributes(*document->tree, document->reporter);
    cascade(*document->tree, document->reporter);
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
    converter.convertRoot(scene::identity, result.scene.root.children);
    return result;
}

}  // namespace vtm::svg

// Images: bitmaps and nested SVG documents. Source: SVG 2 section 12.3.

#include <fmt/format.h>

#include <glm/common.hpp>

#include <vtm/image/codec.hpp>
#include "svg/convert/nested_document.hpp"
#include "svg/xml/resource.hpp"

namespace vtm::svg {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool looksLikeSvg(const Bytes& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                std::min<std::size_t>(bytes.size(), 4096));
    const bool gzip = text.starts_with("\x1f\x8b"),
               utf16 = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
    return gzip || utf16 || (text.find('<') != text.npos && trim(text.substr(0, text.find('<'))).size() <= 3);
}

/// What the viewport shows of a bitmap: with `slice` all of it along one axis, else all of it.
Box shownPart(const Box& whole, const Rect& viewport, const AspectRatio& ratio,
              const scene::Affine& toPixels) {
    if (ratio.fit != scene::Fit::Cover)
        return whole;
    Box shown = geometry::mapped(toBox(viewport), toPixels).intersection(whole);
    const int full = viewport.width * whole.height() >= viewport.height * whole.width() ? 0 : 1;
    shown.min[full] = whole.min[full];
    shown.max[full] = whole.max[full];
    return shown;
}

}  // namespace

void Converter::convertImage(const Element& element, const Scope& scope, Nodes& out) {
    const auto href = hrefOf(element);
    if (!href || href->empty()) {
        reporter_.warn(Kind::Reference, element, "has no href");
        return;
    }
    const ImageContent content = imageContent(*href, element);
    const std::optional<Viewport> size = sizeOf(content);
    if (!size)
        return;
    const LengthReader reader = lengths(element, scope);
    const auto width = reader.length("width", Axis::X), height = reader.length("height", Axis::Y);
    Rect viewport{reader.lengthOr("x", Axis::X, 0), reader.lengthOr("y", Axis::Y, 0), 0, 0};
    viewport.width = width.value_or(height ? *height * size->width / size->height : size->width);
    viewport.height = height.value_or(width ? *width * size->height / size->width : size->height);
    const Box box = toBox(viewport);
    if (!(viewport.width > 0 && viewport.height > 0) ||
        !isWithinReach(geometry::mapped(box, scope.transform)))
        return;
    if (outlineListeners_ > 0)
        outlines_.push_back(
            {std::make_shared<const scene::Path>(scene::rectangle(box.min, box.max)), scope.transform});
    if (!scope.style.visible)
        return;
    const AspectRatio ratio = parseAspectRatio(element.get("preserveAspectRatio"));
    if (const auto* bitmap = std::get_if<std::shared_ptr<const image::Bitmap>>(&content))
        placeBitmap(*bitmap, element, viewport, ratio, scope, out);
    else if (const auto* document = std::get_if<std::shared_ptr<NestedDocument>>(&content))
        placeNested(**document, element, viewport, ratio, scope, out);
}

void Converter::placeNested(NestedDocument& document, const Element& element, const Rect& viewport,
                            const AspectRatio& ratio, const Scope& scope, Nodes& out) {
    document.converter.standFor(placeOf(element));
    placeDocument(document, viewport, ratio, scope, out);
}

/// OpenType 1.9, table `SVG `: the viewport is an em, nothing is clipped to it, and the text gives its
/// colour.
std::shared_ptr<Converter::NestedDocument> Converter::svgGlyph(const TextElement& text,
                                                               const PlacedGlyph& glyph,
                                                               const text::SvgGlyph& svg) {
    const auto [found, fresh] = svgGlyphs_.try_emplace({glyph.font.get(), glyph.id});
    if (!fresh)
        return found->second;
    const scene::Color& color = text.scope.style.color;
    Options options = options_;
    options.fileName = "glyph in " + glyph.font->family();
    options.resourceDirectory.clear();
    options.defaultWidth = options.defaultHeight = glyph.font->unitsPerEm();
    options.styleSheet = fmt::format("svg{{overflow:visible;color:rgba({}%,{}%,{}%,{})}}", color.r * 100,
                                     color.g * 100, color.b * 100, color.a);
    try {
        found->second =
            std::make_shared<NestedDocument>(svg.document, std::move(options), reporter_.warnings(), budget_);
    } catch (const ParseError& error) {
        reporter_.warn(Kind::Font, *text.element, fmt::format("a glyph cannot be drawn: {}", error.what()));
    }
    return found->second;
}

void Converter::convertSvgGlyph(const TextElement& text, const PlacedGlyph& glyph, const text::SvgGlyph& svg,
                                const scene::Affine& transform, Nodes& out) {
    const std::shared_ptr<NestedDocument> document =
        budget_.imageDepth < maxNested ? svgGlyph(text, glyph, svg) : nullptr;
    const Element* element =
        document ? document->parsed->tree->byId(fmt::format("glyph{}", glyph.id)) : nullptr;
    if (!element)
        return;
    ++budget_.imageDepth;
    document->converter.standFor(placeOf(*text.element));
    document->converter.convertOnly(*element, transform, out);
    --budget_.imageDepth;
}

std::optional<Viewport> Converter::sizeOf(const ImageContent& content) {
    if (const auto* bitmap = std::get_if<std::shared_ptr<const image::Bitmap>>(&content))
        return Viewport{static_cast<double>((*bitmap)->width), static_cast<double>((*bitmap)->height)};
    if (const auto* document = std::get_if<std::shared_ptr<NestedDocument>>(&content))
        return (*document)->converter.rootSize();
    return std::nullopt;
}

Converter::ImageContent Converter::imageContent(std::string_view href, const Element& element) {
    if (const auto found = images_.find(href); found != images_.end())
        return found->second;
    ImageContent content;
    try {
        content = loadImage(href);
    } catch (const limits::Exceeded&) {
        throw;
    } catch (const std::runtime_error& error) {
        const bool data = isDataUrl(href);
        reporter_.warn(Kind::Reference, element,
                       fmt::format("the image {}cannot be drawn: {}",
                                   data ? "" : fmt::format("\"{}\" ", href.substr(0, 200)), error.what()));
    }
    return images_.emplace(href, std::move(content)).first->second;
}

Converter::ImageContent Converter::loadImage(std::string_view href) {
    const Bytes bytes = readResource(href, options_.resourceDirectory, options_.resourceRoot);
    if (looksLikeSvg(bytes)) {
        if (budget_.imageDepth >= maxNested)
            throw image::CodecError("images are nested too deep");
        Options options = options_;
        options.fileName = isDataUrl(href) ? "image in " + options_.fileName : std::string(href);
        options.styleSheet.clear();
        options.resourceDirectory.clear();  // an image may not load further files (SVG 2 section 2.2)
        return std::make_shared<NestedDocument>(bytes, std::move(options), reporter_.warnings(), budget_);
    }
    image::Bitmap bitmap = image::decode(bytes);
    const std::int64_t pixels = std::int64_t(bitmap.width) * bitmap.height;
    if (pixels > budget_.imagePixels)
        throw image::CodecError("the images have too many pixels together");
    budget_.imagePixels -= pixels;
    return std::make_shared<const image::Bitmap>(std::move(bitmap));
}

/// The bitmap as a rectangle in its own pixels: all of it, or with `slice` what the viewport shows.
void Converter::placeBitmap(const std::shared_ptr<const image::Bitmap>& bitmap, const Element& element,
                            const Rect& viewport, const AspectRatio& ratio, const Scope& scope, Nodes& out) {
    const Rect whole{0, 0, static_cast<double>(bitmap->width), static_cast<double>(bitmap->height)};
    const scene::Affine toUser = scene::fittedMap(whole, ratio, viewport);
    const auto toPixels = scene::inverse(toUser);
    const scene::Affine transform = scene::compose(scope.transform, toUser);
    if (!toPixels || !scene::inverse(transform))
        return;
    const auto [min, max] = shownPart(toBox(whole), viewport, ratio, *toPixels);
    out.push_back({scene::Item{
        std::make_shared<const scene::Path>(scene::rectangle(min, max)), transform, scene::FillRule::NonZero,
        scene::ImagePaint{bitmap, scope.style.imageFilter, scene::identity}, 1, placeOf(element)}});
}

void Converter::placeDocument(NestedDocument& document, const Rect& viewport, const AspectRatio& ratio,
                              const Scope& scope, Nodes& out) {
    const Viewport size = document.converter.rootSize();
    if (!(size.width > 0 && size.height > 0))
        return;
    const scene::Affine placement =
        scene::compose(scope.transform, scene::fittedMap({0, 0, size.width, size.height}, ratio, viewport));
    Nodes nodes;
    ++budget_.imageDepth;
    document.converter.convertRoot(placement, nodes);
    --budget_.imageDepth;
    scene::Group group;  // a picture of its own: nothing in it blends with what lies below
    appendClipped(viewport, scope.transform, std::move(nodes), group.children);
    appendGroup(std::move(group), true, out);
}

}  // namespace vtm::svg

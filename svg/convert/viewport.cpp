// Elements that establish viewports: svg, symbol; and use, which gives them their size.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include <vtm/image/codec.hpp>
#include "svg/convert/nested_document.hpp"
#include "svg/geometry/path_geometry.hpp"
#include "svg/xml/resource.hpp"

namespace vtm::svg {
namespace {

bool isAncestorOf(const Element& ancestor, const Element& element) {
    for (const Element* e = &element; e; e = e->parent)
        if (e == &ancestor)
            return true;
    return false;
}

/// One side of the root viewport: a length, or a share of the viewBox or else of the default.
std::optional<double> rootSide(const LengthReader& reader, std::string_view name, Axis axis,
                               const std::optional<double>& viewBoxSide, double fallback) {
    const auto length = parseLength(reader.text(name), reader.units);
    if (length && length->percent)
        return length->of(viewBoxSide.value_or(fallback));
    return length ? std::optional(resolve(*length, axis, reader.viewport)) : std::nullopt;
}

}  // namespace

/// A side that is absent follows from the other one and the viewBox's proportions.
Viewport Converter::computeRootSize() {
    const Element& root = *tree_.root;
    const Viewport fallback{options_.defaultWidth, options_.defaultHeight};
    const LengthReader reader{root, styleOf(root), fallback, unitsFor(styleOf(root))};
    const auto box = parseViewBox(root.get("viewBox"));
    const auto boxWidth = box ? std::optional(box->width) : std::nullopt;
    const auto boxHeight = box ? std::optional(box->height) : std::nullopt;
    const auto width = rootSide(reader, "width", Axis::X, boxWidth, fallback.width);
    const auto height = rootSide(reader, "height", Axis::Y, boxHeight, fallback.height);
    if (box && width.has_value() != height.has_value())
        return width ? Viewport{*width, *width * box->height / box->width}
                     : Viewport{*height * box->width / box->height, *height};
    return {width.value_or(boxWidth.value_or(fallback.width)),
            height.value_or(boxHeight.value_or(fallback.height))};
}

void Converter::convertRoot(const scene::Affine& placement, Nodes& out) {
    Scope outside;
    outside.style.fontSize = options_.defaultFontSize;
    outside.transform = placement;
    outside.viewport = rootSize_;
    convertElement(*tree_.root, outside, out);
}

void Converter::convertOnly(const Element& element, const scene::Affine& placement, Nodes& out) {
    only_ = &element;
    convertRoot(placement, out);
}

void Converter::convertSvg(const Element& element, const Scope& scope, Nodes& out) {
    if (&element == tree_.root && scope.depth == 1) {
        const Rect canvas{0, 0, rootSize_.width, rootSize_.height};
        if (!only_)
            fillBackground(scope, canvas, out);
        return convertViewport(element, canvas, scope, out);
    }
    const LengthReader reader = lengths(element, scope);
    convertViewport(element,
                    {reader.lengthOr("x", Axis::X, 0), reader.lengthOr("y", Axis::Y, 0),
                     reader.lengthOr("width", Axis::X, scope.viewport.width),
                     reader.lengthOr("height", Axis::Y, scope.viewport.height)},
                    scope, out);
}

/// CSS gives the outermost svg a background like any box.
void Converter::fillBackground(const Scope& scope, const Rect& canvas, Nodes& out) {
    if (scope.style.background && scope.style.background->a > 0)
        out.push_back({scene::Item{
            std::make_shared<const scene::Path>(scene::rectangle(toBox(canvas).min, toBox(canvas).max)),
            scope.transform, scene::FillRule::NonZero, *scope.style.background, 1, placeOf(*tree_.root)}});
}

void Converter::convertViewport(const Element& element, const Rect& viewport, const Scope& scope,
                                Nodes& out) {
    if (!(viewport.width > 0 && viewport.height > 0)) {
        reporter_.warn(Kind::Value, element, "width and height must be positive; it is left out");
        return;
    }
    if (isEmptyViewBox(element.get("viewBox"))) {
        reporter_.warn(Kind::Value, element,
                       "viewBox=" + quoted(element.get("viewBox")) + " is empty; nothing of it is drawn");
        return;
    }
    const auto viewBox = parseViewBox(element.get("viewBox"));
    const scene::Affine inner =
        viewBox ? scene::fittedMap(*viewBox, parseAspectRatio(element.get("preserveAspectRatio")), viewport)
                : scene::translation(viewport.x, viewport.y);
    Scope content = scope;
    content.transform = scene::compose(scope.transform, inner);
    content.viewport =
        viewBox ? Viewport{viewBox->width, viewBox->height} : Viewport{viewport.width, viewport.height};
    if (!scene::inverse(content.transform))
        return;
    // What the root's viewport cuts off, the picture's edge or the image's viewport cuts off anyway.
    const bool visible = &element == tree_.root || scope.style.overflow.value_or(false);
    Nodes nodes;
    convertChildren(element, content, visible ? out : nodes);
    appendClipped(viewport, scope.transform, std::move(nodes), out);
}

void Converter::appendClipped(const Rect& rect, const scene::Affine& transform, Nodes content, Nodes& out) {
    const auto toRect = scene::inverse(transform);
    if (content.empty() || !toRect)
        return;
    if (liesInside(content, *toRect, toBox(rect))) {
        std::move(content.begin(), content.end(), std::back_inserter(out));
        return;
    }
    auto clip = std::make_shared<scene::Clip>();
    const Box box = toBox(rect);
    clip->shapes.push_back({std::make_shared<const scene::Path>(scene::rectangle(box.min, box.max)),
                            transform, scene::FillRule::NonZero, nullptr});
    scene::Group group;
    group.children = std::move(content);
    group.clip = std::move(clip);
    out.push_back({std::move(group)});
}

void Converter::convertUse(const Element& element, const Scope& scope, Nodes& out) {
    const std::string_view href = hrefOf(element).value_or(std::string_view{});
    const Element* target = tree_.byHref(href);
    if (!target && href.find('#') != href.npos && !href.starts_with('#'))
        return convertForeignUse(element, href, scope, out);
    if (!target) {
        reporter_.warn(Kind::Reference, element,
                       href.empty() ? "refers to nothing"
                                    : "refers to \"" + std::string(href) + "\", which is not here");
        return;
    }
    const Expansion expansion(active_, *target);
    if (!expansion || isAncestorOf(*target, element)) {
        reporter_.warn(Kind::Reference, element, "refers to itself, directly or indirectly; it is left out");
        return;
    }
    const ContextElement context{element, scope, {}};
    Scope inner = scope;
    inner.context = &context;
    convertUsed(element, *target, inner, out);
}

void Converter::convertForeignUse(const Element& use, std::string_view href, const Scope& scope, Nodes& out) {
    const std::size_t end = href.find('#');
    const std::shared_ptr<NestedDocument> document = foreignDocument(href.substr(0, end), use);
    if (!document)
        return;
    const Element* target = document->parsed->tree->byHref(href.substr(end));
    if (!target) {
        reporter_.warn(Kind::Reference, use, "refers to " + quoted(href) + ", which is not there");
        return;
    }
    Converter& other = document->converter;
    const Expansion expansion(other.active_, *target);
    if (!expansion) {
        reporter_.warn(Kind::Reference, use, "refers to itself, directly or indirectly; it is left out");
        return;
    }
    const ContextElement context{use, scope, {}};
    Scope inner = scope;
    inner.context = &context;
    ++budget_.imageDepth;
    other.standFor(placeOf(use));
    other.outlineListeners_ += outlineListeners_;
    other.convertUsed(use, *target, inner, out);
    other.outlineListeners_ -= outlineListeners_;
    --budget_.imageDepth;
    if (outlineListeners_ > 0)
        std::move(other.outlines_.begin(), other.outlines_.end(), std::back_inserter(outlines_));
    other.outlines_.clear();
}

/// Its references start in its own folder; those of an image lead nowhere (SVG 2 section 2.2).
std::shared_ptr<Converter::NestedDocument> Converter::foreignDocument(std::string_view file,
                                                                      const Element& use) {
    const auto [found, isNew] = foreign_.try_emplace(file);
    if (!isNew)
        return found->second;
    try {
        if (budget_.imageDepth >= maxNested)
            throw image::CodecError("documents are nested too deep");
        const std::vector<std::uint8_t> bytes =
            readResource(file, options_.resourceDirectory, options_.resourceRoot);
        Options options = options_;
        options.fileName = isDataUrl(file) ? "document in " + options_.fileName : std::string(file);
        options.exportId.clear();
        if (!isDataUrl(file))
            options.resourceDirectory =
                (std::filesystem::path(options_.resourceDirectory) / percentDecoded(file))
                    .parent_path()
                    .string();
        found->second =
            std::make_shared<NestedDocument>(bytes, std::move(options), reporter_.warnings(), budget_);
    } catch (const limits::Exceeded&) {
        throw;
    } catch (const std::runtime_error& error) {
        reporter_.warn(Kind::Reference, use,
                       "the document " + quoted(file.substr(0, 200)) + " cannot be used: " + error.what());
    }
    return found->second;
}

void Converter::convertUsed(const Element& use, const Element& target, const Scope& scope, Nodes& out) {
    if (target.tag != Tag::Svg && target.tag != Tag::Symbol)
        return convertElement(target, scope, out);
    const std::optional<Scope> entered = spend() ? enter(target, scope) : std::nullopt;
    if (!entered)
        return;
    // The use's own size, where given, replaces the target's (SVG 2 section 5.6.2).
    const LengthReader outer = lengths(use, scope), inner = lengths(target, *entered);
    const auto side = [&](std::string_view name, Axis axis, double full) {
        const auto given = outer.length(name, axis);
        return given ? *given : inner.lengthOr(name, axis, full);
    };
    const Rect viewport{inner.lengthOr("x", Axis::X, 0), inner.lengthOr("y", Axis::Y, 0),
                        side("width", Axis::X, scope.viewport.width),
                        side("height", Axis::Y, scope.viewport.height)};
    appendWithEffects(target, *entered, out,
                      [&](Nodes& content) { convertViewport(target, viewport, *entered, content); });
}

}  // namespace vtm::svg

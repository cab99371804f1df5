// Paints: colours, gradients, patterns, images, materials.

#include <cmath>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include "api/tree/keywords.hpp"
#include "api/tree/reader.hpp"

namespace vtm {

/// Nothing where no paint comes next.
std::optional<TreeReader::CountedVtm> TreeReader::paint() {
    const std::string_view at = in_.rest();
    std::optional<Counted<scene::Paint>> found = plainPaint();
    if (!found)
        return std::nullopt;
    scene::Item trial;
    trial.paint = found->part;
    if (auto* pattern = std::get_if<scene::Pattern>(&trial.paint))
        pattern->content = std::make_shared<const scene::Group>();  // the own one is checked already
    check(at, std::move(trial));
    const float opacity = in_.accept("opacity") ? unit("an opacity") : 1;
    return CountedVtm{Vtm::paint(std::move(found->part), opacity), found->nodes};
}

std::optional<TreeReader::Counted<scene::Paint>> TreeReader::plainPaint() {
    if (in_.accept("linear"))
        return linear();
    if (in_.accept("radial"))
        return radial();
    if (in_.accept("pattern"))
        return pattern();
    if (in_.accept("image"))
        return image();
    if (in_.accept("material"))
        return material();
    if (const auto found = color())
        return Counted<scene::Paint>{*found, 1};
    return std::nullopt;
}

// ---- Colours ----------------------------------------------------------------------------------------

/// Nothing where no colour comes next. CSS's notations, and color(srgb R G B / A).
std::optional<scene::Color> TreeReader::color() {
    const std::string_view at = in_.rest(), word = in_.peek();
    const bool isFunction = at.substr(word.size()).starts_with('(');
    if (isFunction && word == "color")
        return colorFunction();
    svg::Cursor cursor(at);
    const auto read = isFunction || word == "#" ? svg::readColor(cursor) : svg::namedColor(word);
    if (read)
        in_.advance(isFunction || word == "#" ? at.size() - cursor.rest().size() : word.size());
    else if (isFunction || word == "#")
        in_.fail(at, "the colour cannot be read");
    return read;
}

scene::Color TreeReader::needColor() {
    const auto found = color();
    if (!found)
        in_.failExpecting("a colour");
    return *found;
}

/// CSS Color 4 section 10, for channels that are no multiples of 1/255.
scene::Color TreeReader::colorFunction() {
    in_.next();
    in_.expect("(");
    in_.expect("srgb");
    scene::Color color;
    for (float* channel : {&color.r, &color.g, &color.b})
        *channel = unit("a number");
    if (in_.accept("/"))
        color.a = unit("the alpha");
    in_.expect(")");
    return color;
}

// ---- Gradients --------------------------------------------------------------------------------------

TreeReader::Counted<scene::Paint> TreeReader::linear() {
    const auto [x1, y1, x2, y2] = numbers<4>();
    scene::LinearGradient gradient;
    gradient.start = {x1, y1};
    gradient.end = {x2, y2};
    return withStops(std::move(gradient));
}

TreeReader::Counted<scene::Paint> TreeReader::radial() {
    const auto [x, y, radius] = numbers<3>();
    scene::RadialGradient gradient;
    gradient.center = gradient.focus = {x, y};
    gradient.radius = radius;
    if (in_.accept("focus")) {
        const auto [focusX, focusY, focalRadius] = numbers<3>();
        gradient.focus = {focusX, focusY};
        gradient.focalRadius = focalRadius;
    }
    return withStops(std::move(gradient));
}

template <class Gradient>
TreeReader::Counted<scene::Paint> TreeReader::withStops(Gradient gradient) {
    gradient.spread = keywordOr(keywords::spreads, scene::Spread::Pad);
    paintTransform(gradient.transform);
    in_.expect("{");
    while (!in_.accept("}")) {
        limits::check();
        const float offset = unit("the offset of a stop or '}'");
        gradient.stops.push_back({offset, needColor()});
    }
    const std::size_t nodes = sum(1, gradient.stops.size());
    return {std::move(gradient), nodes};
}

// ---- Patterns, images, materials --------------------------------------------------------------------

TreeReader::Counted<scene::Paint> TreeReader::pattern() {
    const std::string_view at = in_.rest();
    const auto [x1, y1, x2, y2] = numbers<4>();
    scene::Pattern pattern{{x1, y1}, {x2, y2}, std::make_shared<const scene::Group>()};
    check(at, {nullptr, scene::identity, scene::FillRule::NonZero, pattern});
    paintTransform(pattern.transform);
    const CountedVtm content = block();
    pattern.content = group(content, pattern.min, pattern.max);
    return {std::move(pattern), sum(1, content.nodes)};
}

TreeReader::Counted<scene::Paint> TreeReader::image() {
    scene::ImagePaint paint{bitmap()};
    paint.filter = keywordOr(keywords::filters, scene::ImageFilter::Trilinear);
    paintTransform(paint.transform);
    return {std::move(paint), 1};
}

/// A file or a data URL in quotes, or a name.
TreeReader::Bitmap TreeReader::bitmap() {
    if (in_.peek() != "\"")
        return named<Bitmap>("an image (a file in quotes or a name)");
    const std::string_view at = in_.rest();
    const std::string href = in_.string("the name of a file");
    try {
        const auto known = bitmaps_.find(href);
        return known != bitmaps_.end() ? known->second : bitmaps_[href] = decoded(href);
    } catch (const image::CodecError& error) {
        in_.fail(at, fmt::format("the image cannot be read: {}", error.what()));
    }
}

TreeReader::Bitmap TreeReader::decoded(const std::string& href) {
    image::Bitmap bitmap = image::decode(svg::readResource(href, options_.resourceDirectory));
    pixels_ += std::int64_t(bitmap.width) * bitmap.height;
    if (pixels_ > image::maxDecodedPixels)
        throw image::CodecError("the images have too many pixels together");
    return std::make_shared<const image::Bitmap>(std::move(bitmap));
}

TreeReader::Counted<scene::Paint> TreeReader::material() {
    constexpr std::size_t bytesPerNode = 64;  // every use of a material copies its text
    const std::string_view at = in_.rest();
    scene::Material made;
    made.name = in_.word("the name of the material");
    made.fallback = needColor();
    paintTransform(made.transform);
    made.glsl = in_.string("the GLSL text in quotes");
    if (materials_.emplace(made.name, made.glsl).first->second != made.glsl)
        in_.fail(at, fmt::format("the material '{}' has another text than before", made.name));
    const std::size_t nodes = sum(1, made.glsl.size() / bytesPerNode);
    return {std::move(made), nodes};
}

void TreeReader::paintTransform(scene::Affine& map) {
    if (in_.accept("transform"))
        map = transform();
}

}  // namespace vtm

// Clips, masks and selections.

#include <glm/common.hpp>

#include "svg/geometry/path_geometry.hpp"
#include "svg/write/values.hpp"
#include "svg/write/writer.hpp"

namespace vtm::svg {

using namespace scene;

namespace {

/// The least box with whole coordinates round it: adding its size to its corner gives its end exactly.
Box rounded(const Box& box) {
    return box.empty() ? Box{Point(0), Point(0)} : Box{glm::floor(box.min), glm::ceil(box.max)};
}

/// All that is masked and nothing that the mask's content would be cut by.
std::string regionAttributes(const Box& content) {
    const Box region = rounded(content);
    return attribute("maskUnits", "userSpaceOnUse") + attribute("x", number(region.min.x)) +
           attribute("y", number(region.min.y)) + attribute("width", number(region.width())) +
           attribute("height", number(region.height()));
}

/// A mask has no attributes but `mask` for what a group has.
bool isMaskedOnly(const Group& content) {
    return content.opacity == 1 && content.blend == BlendMode::Normal && !content.clip && !content.filter;
}

Item solid(const Shape& shape, const Color& color) {
    return {shape.path, shape.transform, shape.geometry, color};
}

constexpr Color white{1, 1, 1, 1}, black{0, 0, 0, 1};

}  // namespace

const std::string& Writer::clip(const std::shared_ptr<const Clip>& shapes) {
    if (const auto known = clips_.find(shapes); known != clips_.end())
        return known->second;
    const Level level(*this);
    std::string rest = shapes->clip ? reference("clip-path", clip(shapes->clip)) : "";
    rest += ">\n";
    for (const ClipShape& shape : shapes->shapes) {
        limits::check();
        rest += clipShape(shape);
    }
    return clips_[shapes] = definitions_.add("clipPath", rest + "</clipPath>");
}

/// A shape's own clip lies in the space of its element, so an element with a transform cannot have it: a
/// `use` round that element does.
std::string Writer::clipShape(const ClipShape& shape) {
    if (shape.path->empty() || isFlat(shape.transform))
        return "";
    const std::string own = shape.clip ? reference("clip-path", clip(shape.clip)) : "";
    const std::string attributes = transformAttribute("transform", shape.transform) +
                                   (shape.rule == FillRule::EvenOdd ? attribute("clip-rule", "evenodd") : "");
    if (own.empty() || shape.transform == identity)
        return "<" + outline(shape.path) + attributes + own + "/>\n";
    const std::string id =
        definitions_.add("path", attribute("d", pathData(*shape.path)) + attributes + "/>");
    return "<use" + attribute("href", "#" + id) + own + "/>\n";
}

const std::string& Writer::mask(const std::shared_ptr<const Mask>& made) {
    if (const auto known = masks_.find(made); known != masks_.end())
        return known->second;
    const Level level(*this);
    const Group& picture = *made->content;
    const bool maskedOnly = isMaskedOnly(picture);
    const Part inner = aside([&] { maskedOnly ? children(picture) : content(picture); });
    std::string rest = regionAttributes(inner.box);
    if (made->kind == MaskKind::Alpha)
        rest += attribute("mask-type", "alpha");
    if (made->linear)
        rest += attribute("color-interpolation", "linearRGB");
    if (maskedOnly && picture.mask)
        rest += reference("mask", mask(picture.mask));
    return masks_[made] = definitions_.add("mask", rest + ">\n" + inner.text + "</mask>");
}

/// Two groups, of which at every point one is cut away. Where both are there, as in pixels on the boundary in
/// compat mode, they are added. The sides of selections in selections may be the same ones, as in a chain in
/// painter's order, and are written once.
void Writer::select(const Select& selection) {
    const Level level(*this);
    const auto isEmpty = [&](const Link<Group>& content) { return !content || shared(content).text.empty(); };
    const bool inside = !isEmpty(selection.inside), outside = !isEmpty(selection.outside);
    const Part both = aside([&] {
        if (inside)
            side(selection.inside, insideAttribute(selection.mask));
        if (outside)
            side(selection.outside, outsideAttribute(selection.mask, shared(selection.outside).box) +
                                        (inside ? attribute("style", "mix-blend-mode:plus-lighter") : ""));
    });
    if (inside && outside)
        append("<g" + attribute("style", "isolation:isolate") + ">\n", both, "</g>\n");
    else
        append("", both, "");
}

void Writer::side(const std::shared_ptr<const Group>& content, const std::string& attributes) {
    const Part& part = shared(content);
    const std::string id = definitions_.add("g", ">\n" + part.text + "</g>");
    append("<use" + attribute("href", "#" + id) + attributes, {"", part.box}, "/>\n");
}

/// Cuts a group to a shape: strokes do not clip.
std::string Writer::insideAttribute(const Shape& shape) {
    if (const auto* rule = std::get_if<FillRule>(&shape.geometry)) {
        auto made = std::make_shared<Clip>();
        made->shapes.push_back({shape.path, shape.transform, *rule, nullptr});
        return reference("clip-path", clip(made));
    }
    Group content;
    content.children.push_back({solid(shape, black)});
    return maskAttribute(std::move(content), MaskKind::Alpha);
}

/// Cuts a shape out of a group that draws in a box.
std::string Writer::outsideAttribute(const Shape& shape, const Box& content) {
    const Box area = rounded(content);
    Group picture;
    picture.children.push_back({Item{std::make_shared<const Path>(rectangle(area.min, area.max)), identity,
                                     FillRule::NonZero, white}});
    picture.children.push_back({solid(shape, black)});
    return maskAttribute(std::move(picture), MaskKind::Luminance);
}

std::string Writer::maskAttribute(Group content, MaskKind kind) {
    auto made = std::make_shared<Mask>();
    made->content = std::make_shared<const Group>(std::move(content));
    made->kind = kind;
    return reference("mask", mask(made));
}

}  // namespace vtm::svg

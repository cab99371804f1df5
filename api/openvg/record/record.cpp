#include "api/openvg/record/record.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <VG/vgext.h>
#include <fmt/format.h>

#include "api/openvg/draw/pixel_source.hpp"
#include "api/openvg/path/projective.hpp"
#include "api/openvg/record/record_mask.hpp"
#include "api/openvg/state/matrix.hpp"

namespace vtm::openvg {

namespace {

/// The modes whose formulas are the same, on [0, 1] and everywhere in it.
std::optional<scene::BlendMode> counterpartOf(VGint mode) {
    switch (mode) {
        case VG_BLEND_SRC_OVER:
            return scene::BlendMode::Normal;
        case VG_BLEND_MULTIPLY:
            return scene::BlendMode::Multiply;
        case VG_BLEND_SCREEN:
            return scene::BlendMode::Screen;
        case VG_BLEND_DARKEN:
            return scene::BlendMode::Darken;
        case VG_BLEND_LIGHTEN:
            return scene::BlendMode::Lighten;
        case VG_BLEND_ADDITIVE:
            return scene::BlendMode::PlusLighter;
        case VG_BLEND_OVERLAY_KHR:
            return scene::BlendMode::Overlay;
        case VG_BLEND_HARDLIGHT_KHR:
            return scene::BlendMode::HardLight;
        case VG_BLEND_SOFTLIGHT_KHR:
            return scene::BlendMode::SoftLight;
        case VG_BLEND_DIFFERENCE_KHR:
            return scene::BlendMode::Difference;
        case VG_BLEND_EXCLUSION_KHR:
            return scene::BlendMode::Exclusion;
        default:
            return std::nullopt;
    }
}

}  // namespace

Recorder::Recorder(double width, double height)
    : width_(width),
      height_(height),
      flip_{1, 0, 0, -1, 0, height},
      picture_(std::make_shared<scene::Path>(rectangleOf(0, 0, width, height))) {}

void Recorder::refuse(const std::string& why) {
    if (fault_.empty())
        fault_ = fmt::format("call {}: {}", calls_, why);
    throw Error(VTM_NOT_RECORDABLE_ERROR);
}

scene::Scene Recorder::finish() { return {width_, height_, std::move(root_)}; }

// ---- Drawing --------------------------------------------------------------------------------------

void Recorder::drawPath(const State& state, const Path& path, VGbitfield modes, const glm::mat3& toSurface) {
    ++calls_;
    refuseClipLines(state);
    if (path.data.commands().empty() || !inverseOf(toSurface))
        return;
    for (const VGPaintMode mode : {VG_FILL_PATH, VG_STROKE_PATH}) {
        if (!(modes & VGbitfield(mode)))
            continue;
        const glm::mat3& paintToUser = state.matrix(mode == VG_FILL_PATH ? VG_MATRIX_FILL_PAINT_TO_USER
                                                                         : VG_MATRIX_STROKE_PAINT_TO_USER);
        if (isProjective(paintToUser))
            refuse("paint in perspective");
        const Paint& paint = currentPaint(state, mode);
        const scene::Shape shape = shapeOf(state, path, mode, toPicture(toSurface));
        const bool isColor = paint.type == VG_PAINT_TYPE_COLOR;
        if (!shape.path->empty() && (isColor || inverseOf(toSurface * paintToUser)))
            draw(state, painted(shape, paint, affineOf(paintToUser), state, bitmaps_), shape);
    }
}

void Recorder::drawImage(const State& state, const Image& image, const glm::mat3& toSurface) {
    ++calls_;
    refuseClipLines(state);
    if (!inverseOf(toSurface))
        return;
    const scene::Affine toPicture = this->toPicture(toSurface);
    const scene::Shape shape{std::make_shared<scene::Path>(rectangleOf(0, 0, image.width(), image.height())),
                             toPicture, scene::FillRule::NonZero};
    draw(state, imageNode(state, image, shape), shape);
}

scene::Node Recorder::imageNode(const State& state, const Image& image, const scene::Shape& shape) {
    const scene::Affine& toPicture = shape.transform;
    const Paint& paint = currentPaint(state, VG_FILL_PATH);
    if (state.imageMode == VG_DRAW_IMAGE_NORMAL)
        return painted(image, toPicture, state, bitmaps_);
    if (state.imageMode == VG_DRAW_IMAGE_COLOR_MATRIX_NDS)
        return transformed(image, paint, toPicture, state, bitmaps_);
    const bool isProduct = state.imageMode == VG_DRAW_IMAGE_MULTIPLY;
    if (const std::optional<Color> color = colorOf(paint); color && isProduct)
        return multiplied(image, *color, toPicture, state, bitmaps_);
    const glm::mat3& paintToUser = state.matrix(VG_MATRIX_FILL_PAINT_TO_USER);
    if (isProjective(paintToUser))
        refuse("paint in perspective");
    scene::Group group;
    group.children.push_back(painted(shape, paint, affineOf(paintToUser), state, bitmaps_));
    if (isProduct) {
        if (!isOpaque(group.children.front()) || image.format().space.linear || state.colorTransform)
            refuse(
                "an image in mode multiply: by a gradient or a pattern that is translucent, in linear light, "
                "or with a colour transform");
        scene::Group factor;
        factor.children.push_back(opaque(image, toPicture, state, bitmaps_));
        factor.blend = scene::BlendMode::Multiply;
        group.children.push_back({std::move(factor)});
    } else if (!isWhite(image)) {
        refuse("an image in mode stencil that is not white");
    }
    group.mask = std::make_shared<scene::Mask>(scene::Mask{
        openvg::groupOf(alphaOf(image, toPicture, state, bitmaps_)), scene::MaskKind::Alpha, false});
    return {std::move(group)};
}

void Recorder::setPixels(const State& state, const Image& image, const CopyArea& area) {
    ++calls_;
    const scene::Shape shape = writtenShape(state, area.dx, area.dy, area.width, area.height);
    if (!shape.path->empty())
        put({scene::Item{shape.path, shape.transform, shape.geometry, storedPart(image, area, bitmaps_), 1}},
            shape);
}

void Recorder::refuseClipLines(const State& state) {
    if (!clipLines(state).empty())
        refuse("clip lines");
}

scene::Affine Recorder::toPicture(const glm::mat3& toSurface) {
    if (isProjective(toSurface))
        refuse("a matrix in perspective");
    return scene::compose(flip_, affineOf(toSurface));
}

void Recorder::draw(const State& state, scene::Node node, const scene::Shape& shape) {
    const Cut cut = cutOf(state);
    if (state.blendMode == VG_BLEND_DST_KHR || (cut.isScissored && cut.rectangles.empty()))
        return;
    if (state.blendMode == VG_BLEND_DST_OVER)
        return layBelow(std::move(node), cut);
    if (state.blendMode == VG_BLEND_SRC) {
        if (isOpaque(node))
            return lay(std::move(node), scene::BlendMode::Normal, cut);
        if (!cut.isNone())
            refuse("VG_BLEND_SRC of what is translucent, under scissoring or a mask");
        return replace(std::move(node), shape);
    }
    const std::optional<scene::BlendMode> blend = counterpartOf(state.blendMode);
    if (!blend)
        refuse(fmt::format("blend mode 0x{:x}", state.blendMode));
    lay(std::move(node), *blend, cut);
}

void Recorder::clear(const State& state, int x, int y, int width, int height) {
    ++calls_;
    const scene::Color color = clearColor(state);
    const scene::Shape shape = writtenShape(state, x, y, width, height);
    if (shape.path->empty())
        return;
    if (!state.scissoring && x <= 0 && y <= 0 && double(x) + width >= width_ &&
        double(y) + height >= height_) {
        root_.children.clear();
        isPlain_ = true;
        lastCut_ = {};
    }
    put({scene::Item{shape.path, shape.transform, shape.geometry, color, 1}}, shape);
}

/// In place of what is there.
void Recorder::put(scene::Node node, const scene::Shape& shape) {
    if (root_.children.empty() || isOpaque(node))
        lay(std::move(node), scene::BlendMode::Normal, {});
    else
        replace(std::move(node), shape);
}

/// Pixels that scissoring leaves of a rectangle.
scene::Shape Recorder::writtenShape(const State& state, int x, int y, int width, int height) const {
    std::vector<VGint> rectangles;
    if (state.scissoring)
        rectangles = rectanglesOf(state);
    scene::Path path;
    const auto add = [&](double x0, double y0, double x1, double y1) {
        x0 = std::max(x0, double(x));
        y0 = std::max(y0, double(y));
        x1 = std::min(x1, double(x) + width);
        y1 = std::min(y1, double(y) + height);
        if (!(x0 < x1 && y0 < y1))
            return;
        const scene::Path one = rectangleOf(x0, y0, x1 - x0, y1 - y0);
        path.insert(path.end(), one.begin(), one.end());
    };
    for (std::size_t i = 0; i < rectangles.size(); i += 4)
        add(rectangles[i], rectangles[i + 1], double(rectangles[i]) + rectangles[i + 2],
            double(rectangles[i + 1]) + rectangles[i + 3]);
    if (!state.scissoring)
        add(0, 0, width_, height_);
    return {std::make_shared<scene::Path>(std::move(path)), flip_, scene::FillRule::NonZero};
}

// ---- Layers ---------------------------------------------------------------------------------------

Recorder::Cut Recorder::cutOf(const State& state) const {
    Cut cut;
    if (state.scissoring) {
        cut.isScissored = true;
        cut.rectangles = rectanglesOf(state);
    }
    if (state.masking)
        cut.mask = mask_;
    return cut;
}

scene::Group Recorder::groupOf(scene::Node node, const Cut& cut) const {
    scene::Group group;
    group.children.push_back(std::move(node));
    group.clip = cut.mask.clip;
    if (cut.isScissored) {
        scene::Clip clip;
        clip.shapes.push_back({std::make_shared<scene::Path>(outlineOf(cut.rectangles)), flip_,
                               scene::FillRule::NonZero, nullptr});
        clip.clip = cut.mask.clip;
        group.clip = std::make_shared<scene::Clip>(std::move(clip));
    }
    if (cut.mask.alpha)
        group.mask =
            std::make_shared<scene::Mask>(scene::Mask{cut.mask.alpha, scene::MaskKind::Alpha, false});
    return group;
}

void Recorder::lay(scene::Node node, scene::BlendMode blend, const Cut& cut) {
    const bool isNormal = blend == scene::BlendMode::Normal;
    isPlain_ = isPlain_ && isNormal;
    if (isNormal && cut.isNone()) {
        root_.children.push_back(std::move(node));
        lastCut_ = {};
    } else if (isNormal && !lastCut_.isNone() && cut == lastCut_ && !cut.mask.isShare) {
        // Cut together they are what they are cut one by one: at every point the cut is all or nothing.
        std::get<scene::Group>(root_.children.back().value).children.push_back(std::move(node));
    } else {
        scene::Group group = groupOf(std::move(node), cut);
        group.blend = blend;
        root_.children.push_back({std::move(group)});
        lastCut_ = isNormal ? cut : Cut();
    }
}

void Recorder::layBelow(scene::Node node, const Cut& cut) {
    if (!isPlain_) {
        // What was blended has seen nothing below it, and still must not.
        scene::Group above;
        above.children = std::move(root_.children);
        root_.children.clear();
        root_.children.push_back({std::move(above)});
        isPlain_ = true;
        lastCut_ = {};
    }
    if (!cut.isNone())
        node = {groupOf(std::move(node), cut)};
    root_.children.insert(root_.children.begin(), std::move(node));
}

void Recorder::replace(scene::Node node, const scene::Shape& shape) {
    scene::Group inside, outside;
    inside.children.push_back(std::move(node));
    outside.children = std::move(root_.children);
    root_.children.clear();
    root_.children.push_back({scene::Select{shape, std::make_shared<scene::Group>(std::move(inside)),
                                            std::make_shared<scene::Group>(std::move(outside))}});
    isPlain_ = true;
    lastCut_ = {};
}

// Section 7.2 in a recording: masks of shapes.

bool Recorder::covers(const CopyArea& area) const {
    return area.dx == 0 && area.dy == 0 && area.sx == 0 && area.sy == 0 && area.width >= width_ &&
           area.height >= height_;
}

void Recorder::combine(VGMaskOperation operation, const RecordedMask& other) {
    if (operation == VG_SET_MASK) {
        mask_ = other;
    } else if (operation == VG_UNION_MASK) {
        mask_ = unionOf(mask_, other, picture_);
    } else if (operation == VG_INTERSECT_MASK) {
        mask_ = intersectionOf(mask_, other, picture_);
    } else {
        const std::optional<RecordedMask> difference = differenceOf(mask_, other, picture_);
        if (!difference)
            refuse("VG_SUBTRACT_MASK of more than one shape");
        mask_ = *difference;
    }
}

void Recorder::renderToMask(const State& state, const Path& path, VGbitfield modes,
                            VGMaskOperation operation) {
    ++calls_;
    if (operation == VG_CLEAR_MASK || operation == VG_FILL_MASK) {
        mask_ = operation == VG_FILL_MASK ? RecordedMask() : emptyMask();
        return;
    }
    const glm::mat3& toSurface = state.matrix(VG_MATRIX_PATH_USER_TO_SURFACE);
    for (const VGPaintMode mode : {VG_FILL_PATH, VG_STROKE_PATH}) {
        if (!(modes & VGbitfield(mode)))
            continue;
        const scene::Shape shape = shapeOf(state, path, mode, toPicture(toSurface));
        RecordedMask drawn = emptyMask();
        if (!shape.path->empty() && inverseOf(toSurface))
            drawn = maskOf({shape.path, shape.transform, std::get<scene::FillRule>(shape.geometry), nullptr});
        if (state.scissoring)
            drawn = intersectionOf(drawn,
                                   maskOf({std::make_shared<scene::Path>(outlineOf(rectanglesOf(state))),
                                           flip_, scene::FillRule::NonZero, nullptr}),
                                   picture_);
        combine(operation, drawn);
    }
}

void Recorder::mask(const MaskLayer* layer, VGMaskOperation operation, const CopyArea& area) {
    ++calls_;
    if (layer) {
        const auto written = layers_.find(layer->handle);
        if (written == layers_.end())
            return combineValues(layer->mask, operation, area);
        if (!covers(area) || !covers({0, 0, 0, 0, layer->mask.width, layer->mask.height}))
            refuse("a part of a mask layer");
        return combine(operation, written->second);
    }
    const RecordedMask rectangle =
        maskOf({std::make_shared<scene::Path>(rectangleOf(area.dx, area.dy, area.width, area.height)), flip_,
                scene::FillRule::NonZero, nullptr});
    if (covers(area))
        mask_ = operation == VG_FILL_MASK ? RecordedMask() : emptyMask();
    else
        combine(operation == VG_FILL_MASK ? VG_UNION_MASK : VG_SUBTRACT_MASK, rectangle);
}

void Recorder::mask(const MaskValues& values, VGMaskOperation operation, const CopyArea& area) {
    ++calls_;
    combineValues(values, operation, area);
}

void Recorder::combineValues(const MaskValues& values, VGMaskOperation operation, const CopyArea& area) {
    const CopyArea part = clipped(area, maxImageSide, maxImageSide, values.width, values.height);
    if (part.width == 0)
        return;
    // New layers are 1, and cleared ones 0: no image is needed for these.
    const auto isAll = [&](std::uint8_t value) {
        return std::ranges::all_of(values.values(), [&](std::uint8_t v) { return v == value; });
    };
    if (covers(part) && (isAll(255) || isAll(0)))
        return combine(operation, isAll(255) ? RecordedMask() : emptyMask());
    const auto path = std::make_shared<scene::Path>(rectangleOf(part.dx, part.dy, part.width, part.height));
    const scene::Item inside{path, flip_, scene::FillRule::NonZero,
                             storedPart(values, part, operation == VG_SUBTRACT_MASK, bitmaps_)};
    mask_ = combinedWith(mask_, operation, inside, picture_);
}

void Recorder::fillMaskLayer(const MaskLayer& layer, const CopyArea& area, float value) {
    ++calls_;
    if (!covers(area) || (value != 0 && value != 1))
        refuse("a mask layer filled in part");
    layers_[layer.handle] = value == 1 ? RecordedMask() : emptyMask();
}

void Recorder::copyMask(const MaskLayer& layer, const CopyArea& area) {
    ++calls_;
    if (!covers(area) || !covers({0, 0, 0, 0, layer.mask.width, layer.mask.height}))
        refuse("a part of the mask");
    layers_[layer.handle] = mask_;
}

}  // namespace vtm::openvg

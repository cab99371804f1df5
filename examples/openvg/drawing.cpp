#include "examples/openvg/drawing.hpp"

#include <numbers>

#include "examples/openvg/paints.hpp"

namespace drawing {

using namespace vtm;

namespace {

template <class... F>
struct Cases : F... {
    using F::operator()...;
};

/// Segments and coordinates as vgAppendPathData takes them.
struct PathData {
    std::vector<VGubyte> segments;
    std::vector<VGfloat> numbers;

    void add(VGubyte segment, std::initializer_list<scene::Point> points) {
        segments.push_back(segment);
        for (const scene::Point& p : points)
            numbers.insert(numbers.end(), {VGfloat(p.x), VGfloat(p.y)});
    }

    void add(const scene::ArcTo& arc) {
        // y runs down, so what SVG calls sweeping is counter-clockwise to OpenVG, which counts angles from x
        // to y.
        segments.push_back(arc.largeArc ? arc.sweep ? VG_LCCWARC_TO_ABS : VG_LCWARC_TO_ABS
                           : arc.sweep  ? VG_SCCWARC_TO_ABS
                                        : VG_SCWARC_TO_ABS);
        const double degrees = arc.rotation * 180 / std::numbers::pi;
        for (const double number : {arc.radii.x, arc.radii.y, degrees, arc.to.x, arc.to.y})
            numbers.push_back(VGfloat(number));
    }
};

VGPath makePath(const scene::Path& path) {
    PathData data;
    const Cases command{
        [&](const scene::MoveTo& c) { data.add(VG_MOVE_TO_ABS, {c.to}); },
        [&](const scene::LineTo& c) { data.add(VG_LINE_TO_ABS, {c.to}); },
        [&](const scene::QuadTo& c) {
            data.add(VG_QUAD_TO_ABS, {c.control, c.to});
        },
        [&](const scene::CubicTo& c) {
            data.add(VG_CUBIC_TO_ABS, {c.control1, c.control2, c.to});
        },
        [&](const scene::ArcTo& c) { data.add(c); },
        [&](const scene::Close&) { data.add(VG_CLOSE_PATH, {}); },
    };
    for (const scene::Command& c : path)
        std::visit(command, c);
    const VGPath result =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, VGint(data.segments.size()),
                     VGint(data.numbers.size()), VG_PATH_CAPABILITY_APPEND_TO);
    vgAppendPathData(result, VGint(data.segments.size()), data.segments.data(), data.numbers.data());
    return result;
}

VGuint rgba(const scene::Color& color) {
    const auto byte = [](float value) { return VGuint(value * 255 + 0.5f); };
    return byte(color.r) << 24 | byte(color.g) << 16 | byte(color.b) << 8 | byte(color.a);
}

template <class Gradient>
VGPaint finished(VGPaint paint, const Gradient& gradient) {
    vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_PREMULTIPLIED, VG_FALSE);  // SVG mixes straight colours
    vgSetParameteri(paint, VG_PAINT_COLOR_RAMP_SPREAD_MODE,
                    gradient.spread == scene::Spread::Pad       ? VG_COLOR_RAMP_SPREAD_PAD
                    : gradient.spread == scene::Spread::Reflect ? VG_COLOR_RAMP_SPREAD_REFLECT
                                                                : VG_COLOR_RAMP_SPREAD_REPEAT);
    return paint;
}

paints::Ramp rampOf(const std::vector<scene::GradientStop>& stops) {
    paints::Ramp ramp;
    for (const scene::GradientStop& stop : stops)
        ramp.push_back({stop.offset, rgba(stop.color)});
    return ramp;
}

void load(VGMatrixMode mode, const scene::Affine& m) {
    const VGfloat columns[] = {VGfloat(m[0].x), VGfloat(m[0].y), 0, VGfloat(m[1].x), VGfloat(m[1].y), 0,
                               VGfloat(m[2].x), VGfloat(m[2].y), 1};
    vgSeti(VG_MATRIX_MODE, mode);
    vgLoadMatrix(columns);
}

scene::Affine transformOf(const scene::Paint& paint) {
    if (const auto* linear = std::get_if<scene::LinearGradient>(&paint))
        return linear->transform;
    if (const auto* radial = std::get_if<scene::RadialGradient>(&paint))
        return radial->transform;
    return scene::identity;
}

void setStroke(const scene::StrokeStyle& style) {
    vgSetf(VG_STROKE_LINE_WIDTH, VGfloat(style.width));
    vgSeti(VG_STROKE_CAP_STYLE, style.cap == scene::Cap::Butt    ? VG_CAP_BUTT
                                : style.cap == scene::Cap::Round ? VG_CAP_ROUND
                                                                 : VG_CAP_SQUARE);
    vgSeti(VG_STROKE_JOIN_STYLE, style.join == scene::Join::Round   ? VG_JOIN_ROUND
                                 : style.join == scene::Join::Bevel ? VG_JOIN_BEVEL
                                                                    : VG_JOIN_MITER);
    vgSetf(VG_STROKE_MITER_LIMIT, VGfloat(style.miterLimit));
    const std::vector<VGfloat> dashes(style.dashes.begin(), style.dashes.end());
    vgSetfv(VG_STROKE_DASH_PATTERN, VGint(dashes.size()), dashes.data());
    vgSetf(VG_STROKE_DASH_PHASE, VGfloat(style.dashPhase));
    vgSeti(VG_STROKE_DASH_PHASE_RESET, VG_TRUE);  // SVG starts each subpath with the first dash
}

}  // namespace

Drawing::Drawing(scene::Scene scene) : scene_(std::move(scene)) {
    prepare(scene_.root);
    const auto frame = std::make_shared<scene::Path>(scene::rectangle({0, 0}, {scene_.width, scene_.height}));
    frame_.shapes.push_back({frame, scene::identity, scene::FillRule::NonZero, nullptr});
    prepareClip(&frame_);
}

Drawing::~Drawing() {
    for (const auto& [path, handle] : paths_)
        vgDestroyPath(handle);
    for (const auto& [item, handle] : paints_)
        vgDestroyPaint(handle);
}

void Drawing::prepare(const scene::Group& group) {
    leftOut_ += group.mask != nullptr || group.blend != scene::BlendMode::Normal;
    prepareClip(group.clip.get());
    const Cases node{
        [&](const scene::Item& item) {
            if (const VGPaint paint = paintOf(item.paint)) {
                pathOf(item.path);
                paints_[&item] = paint;
            }
        },
        [&](const scene::Group& child) { prepare(child); },
        [&](const scene::Select&) { ++leftOut_; },
    };
    for (const scene::Node& child : group.children)
        std::visit(node, child.value);
}

void Drawing::prepareClip(const scene::Clip* clip) {
    for (; clip; clip = clip->clip.get())
        for (const scene::ClipShape& shape : clip->shapes) {
            pathOf(shape.path);
            leftOut_ += shape.clip != nullptr;
        }
}

VGPath Drawing::pathOf(const std::shared_ptr<const scene::Path>& path) {
    const auto [place, isNew] = paths_.try_emplace(path.get());
    if (isNew)
        place->second = makePath(*path);
    return place->second;
}

VGPaint Drawing::paintOf(const scene::Paint& paint) {
    return std::visit(
        Cases{
            [](const scene::Color& color) { return paints::solid(rgba(color)); },
            [](const scene::LinearGradient& g) {
                return finished(paints::linear(VGfloat(g.start.x), VGfloat(g.start.y), VGfloat(g.end.x),
                                               VGfloat(g.end.y), rampOf(g.stops)),
                                g);
            },
            [](const scene::RadialGradient& g) {
                return finished(paints::radial(VGfloat(g.center.x), VGfloat(g.center.y), VGfloat(g.focus.x),
                                               VGfloat(g.focus.y), VGfloat(g.radius), rampOf(g.stops)),
                                g);
            },
            [&](const auto&) {
                ++leftOut_;
                return VGPaint(VG_INVALID_HANDLE);
            },
        },
        paint);
}

void Drawing::draw(const scene::Affine& toSurface, int surfaceWidth, int surfaceHeight) {
    toSurface_ = toSurface;
    surfaceWidth_ = surfaceWidth;
    surfaceHeight_ = surfaceHeight;
    vgSeti(VG_MASKING, VG_TRUE);
    vgMask(VG_INVALID_HANDLE, VG_FILL_MASK, 0, 0, surfaceWidth, surfaceHeight);
    intersectMask(frame_);
    vgSeti(VG_COLOR_TRANSFORM, VG_TRUE);
    drawGroup(scene_.root, 1);
    vgSeti(VG_COLOR_TRANSFORM, VG_FALSE);
    vgSeti(VG_MASKING, VG_FALSE);
}

void Drawing::drawGroup(const scene::Group& group, float opacity) {
    VGMaskLayer before = VG_INVALID_HANDLE;
    if (group.clip) {
        before = vgCreateMaskLayer(surfaceWidth_, surfaceHeight_);
        vgCopyMask(before, 0, 0, 0, 0, surfaceWidth_, surfaceHeight_);
        for (const scene::Clip* clip = group.clip.get(); clip; clip = clip->clip.get())
            intersectMask(*clip);
    }
    const Cases node{
        [&](const scene::Item& item) { drawItem(item, opacity * group.opacity); },
        [&](const scene::Group& child) { drawGroup(child, opacity * group.opacity); },
        [](const scene::Select&) {},
    };
    for (const scene::Node& child : group.children)
        std::visit(node, child.value);
    if (before) {
        vgMask(before, VG_SET_MASK, 0, 0, surfaceWidth_, surfaceHeight_);
        vgDestroyMaskLayer(before);
    }
}

void Drawing::intersectMask(const scene::Clip& clip) {
    const VGMaskLayer before = vgCreateMaskLayer(surfaceWidth_, surfaceHeight_);
    vgCopyMask(before, 0, 0, 0, 0, surfaceWidth_, surfaceHeight_);
    vgMask(VG_INVALID_HANDLE, VG_CLEAR_MASK, 0, 0, surfaceWidth_, surfaceHeight_);
    for (const scene::ClipShape& shape : clip.shapes) {
        load(VG_MATRIX_PATH_USER_TO_SURFACE, scene::compose(toSurface_, shape.transform));
        vgSeti(VG_FILL_RULE, shape.rule == scene::FillRule::NonZero ? VG_NON_ZERO : VG_EVEN_ODD);
        vgRenderToMask(paths_.at(shape.path.get()), VG_FILL_PATH, VG_UNION_MASK);
    }
    vgMask(before, VG_INTERSECT_MASK, 0, 0, surfaceWidth_, surfaceHeight_);
    vgDestroyMaskLayer(before);
}

void Drawing::drawItem(const scene::Item& item, float opacity) {
    const auto paint = paints_.find(&item);
    if (paint == paints_.end())
        return;
    const VGfloat scaleAndBias[] = {1, 1, 1, item.opacity * opacity, 0, 0, 0, 0};
    vgSetfv(VG_COLOR_TRANSFORM_VALUES, 8, scaleAndBias);
    load(VG_MATRIX_PATH_USER_TO_SURFACE, scene::compose(toSurface_, item.transform));
    const VGPath path = paths_.at(item.path.get());
    if (const auto* rule = std::get_if<scene::FillRule>(&item.geometry)) {
        load(VG_MATRIX_FILL_PAINT_TO_USER, transformOf(item.paint));
        vgSeti(VG_FILL_RULE, *rule == scene::FillRule::NonZero ? VG_NON_ZERO : VG_EVEN_ODD);
        vgSetPaint(paint->second, VG_FILL_PATH);
        vgDrawPath(path, VG_FILL_PATH);
    } else {
        load(VG_MATRIX_STROKE_PAINT_TO_USER, transformOf(item.paint));
        setStroke(std::get<scene::StrokeStyle>(item.geometry));
        vgSetPaint(paint->second, VG_STROKE_PATH);
        vgDrawPath(path, VG_STROKE_PATH);
    }
}

}  // namespace drawing

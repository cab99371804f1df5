#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_COLOR_H

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "text/color/color_glyph.hpp"
#include "text/color/composite.hpp"
#include "text/color/free_type_face.hpp"
#include "text/color/gradients.hpp"

namespace vtm::text {
namespace {

using scene::Affine;
using scene::NodeList;
using scene::Point;

double number(FT_Fixed fixed) { return double(fixed) / 65536; }
double angle(FT_Fixed halfTurns) { return number(halfTurns) * std::numbers::pi; }
/// Fonts have y up.
Point point(const FT_Vector& v) { return {number(v.x), -number(v.y)}; }

/// Fonts' matrices, for y down.
Affine affine(double xx, double xy, double dx, double yx, double yy, double dy) {
    return {xx, -yx, -xy, yy, dx, -dy};
}

Affine around(const Affine& linear, FT_Fixed x, FT_Fixed y) {
    const Point center = point({x, y});
    return scene::compose(scene::compose(scene::translation(center.x, center.y), linear),
                          scene::translation(-center.x, -center.y));
}

Affine transformOf(const FT_Affine23& m) {
    return affine(number(m.xx), number(m.xy), number(m.dx), number(m.yx), number(m.yy), number(m.dy));
}

Affine rotationOf(const FT_PaintRotate& rotate) {
    const double c = std::cos(angle(rotate.angle)), s = std::sin(angle(rotate.angle));
    return around(affine(c, -s, 0, s, c, 0), rotate.center_x, rotate.center_y);
}

Affine skewOf(const FT_PaintSkew& skew) {
    const double x = std::tan(angle(skew.x_skew_angle)), y = std::tan(angle(skew.y_skew_angle));
    return around(affine(1, -x, 0, y, 1, 0), skew.center_x, skew.center_y);
}

scene::Spread spreadOf(FT_PaintExtend extend) {
    if (extend == FT_COLR_PAINT_EXTEND_REPEAT)
        return scene::Spread::Repeat;
    return extend == FT_COLR_PAINT_EXTEND_REFLECT ? scene::Spread::Reflect : scene::Spread::Pad;
}

/// What a paint without an outline of its own fills.
struct Place {
    std::shared_ptr<const scene::Path> path;
    Affine pathTransform;  ///< the path's space to the glyph's
    Affine transform;      ///< the paint's space to the glyph's
};

/// Around the path's points, controls included, in the paint's space.
Extent extentOf(const scene::Path& path, const Affine& toPaint) {
    Extent extent{Point(HUGE_VAL), Point(-HUGE_VAL)};
    const auto add = [&](Point p) {
        p = scene::apply(toPaint, p);
        extent = {glm::min(extent.min, p), glm::max(extent.max, p)};
    };
    for (const scene::Command& command : path) {
        if (const auto end = scene::endOf(command))
            add(*end);
        if (const auto* quad = std::get_if<scene::QuadTo>(&command))
            add(quad->control);
        if (const auto* cubic = std::get_if<scene::CubicTo>(&command)) {
            add(cubic->control1);
            add(cubic->control2);
        }
    }
    return extent;
}

scene::Group clipped(NodeList nodes, const Place& place) {
    scene::ClipShape shape;
    shape.path = place.path;
    shape.transform = place.pathTransform;
    scene::Clip clip;
    clip.shapes.push_back(std::move(shape));
    scene::Group group;
    group.children = std::move(nodes);
    group.clip = std::make_shared<const scene::Clip>(std::move(clip));
    return group;
}

/// Walks the graph of a glyph's paints. They form a graph, not a tree, and may share parts many times over:
/// the number of visits is bounded.
class Painter {
public:
    Painter(const ColorSource& source, FT_Face face) : source_(source), face_(face) {}

    /// False where the glyph has no paints.
    bool glyph(GlyphId id, const Affine& transform, NodeList& out) {
        FT_OpaquePaint paint{};
        if (!FT_Get_Color_Glyph_Paint(face_, id, FT_COLOR_NO_ROOT_TRANSFORM, &paint))
            return false;
        Place place = whole(transform);
        FT_ClipBox box;
        const bool hasBox = FT_Get_Color_Glyph_ClipBox(face_, id, &box);
        if (hasBox)
            place.path = rectangleOf(box);
        NodeList nodes;
        draw(paint, place, nodes);
        if (hasBox)
            out.push_back({clipped(std::move(nodes), place)});
        else
            std::move(nodes.begin(), nodes.end(), std::back_inserter(out));
        return true;
    }

    bool isExhausted() const { return visits_ > maxColorPaints; }

private:
    static constexpr int maxDepth = 64;

    /// FreeType's numbers are 64 to a pixel, and a pixel is a font unit.
    static std::shared_ptr<const scene::Path> rectangleOf(const FT_ClipBox& box) {
        constexpr double scale = 64;
        const Point min(double(box.bottom_left.x), -double(box.top_right.y));
        const Point max(double(box.top_right.x), -double(box.bottom_left.y));
        return std::make_shared<const scene::Path>(scene::rectangle(min / scale, max / scale));
    }

    /// All that a glyph may cover: fonts must bound their paints, and transforms may move outlines.
    Place whole(const Affine& transform) const {
        constexpr double ems = 16;
        const double side = ems * source_.outlines.unitsPerEm();
        return {std::make_shared<const scene::Path>(scene::rectangle(Point(-side), Point(side))), transform,
                transform};
    }

    void draw(const FT_OpaquePaint& paint, const Place& place, NodeList& out) {
        FT_COLR_Paint p;
        if (++visits_ > maxColorPaints || depth_ >= maxDepth || !FT_Get_Paint(face_, paint, &p))
            return;
        ++depth_;
        drawPaint(p, place, out);
        --depth_;
    }

    void drawPaint(FT_COLR_Paint& p, const Place& place, NodeList& out) {
        switch (p.format) {
            case FT_COLR_PAINTFORMAT_COLR_LAYERS:
                return layers(p.u.colr_layers.layer_iterator, place, out);
            case FT_COLR_PAINTFORMAT_SOLID:
                return fill(colorOf(p.u.solid.color), place, out);
            case FT_COLR_PAINTFORMAT_LINEAR_GRADIENT:
                return linear(p.u.linear_gradient, place, out);
            case FT_COLR_PAINTFORMAT_RADIAL_GRADIENT:
                return radial(p.u.radial_gradient, place, out);
            case FT_COLR_PAINTFORMAT_SWEEP_GRADIENT:
                return sweep(p.u.sweep_gradient, place, out);
            case FT_COLR_PAINTFORMAT_GLYPH:
                return outline(p.u.glyph, place, out);
            case FT_COLR_PAINTFORMAT_COLR_GLYPH:
                ++outlines_;
                glyph(p.u.colr_glyph.glyphID, place.transform, out);
                return;
            case FT_COLR_PAINTFORMAT_COMPOSITE:
                return composite(p.u.composite, place, out);
            default:
                return drawTransformed(p, place, out);
        }
    }

    void drawTransformed(const FT_COLR_Paint& p, const Place& place, NodeList& out) {
        switch (p.format) {
            case FT_COLR_PAINTFORMAT_TRANSFORM:
                return moved(p.u.transform.paint, transformOf(p.u.transform.affine), place, out);
            case FT_COLR_PAINTFORMAT_TRANSLATE:
                return moved(p.u.translate.paint,
                             scene::translation(number(p.u.translate.dx), -number(p.u.translate.dy)), place,
                             out);
            case FT_COLR_PAINTFORMAT_SCALE: {
                const FT_PaintScale& s = p.u.scale;
                const Affine scale = scene::scaling(number(s.scale_x), number(s.scale_y));
                return moved(s.paint, around(scale, s.center_x, s.center_y), place, out);
            }
            case FT_COLR_PAINTFORMAT_ROTATE:
                return moved(p.u.rotate.paint, rotationOf(p.u.rotate), place, out);
            case FT_COLR_PAINTFORMAT_SKEW:
                return moved(p.u.skew.paint, skewOf(p.u.skew), place, out);
            default:
                return;  // of a later version
        }
    }

    void moved(const FT_OpaquePaint& paint, const Affine& by, Place place, NodeList& out) {
        place.transform = scene::compose(place.transform, by);
        draw(paint, place, out);
    }

    void layers(FT_LayerIterator& iterator, const Place& place, NodeList& out) {
        FT_OpaquePaint paint{};
        while (!isExhausted() && FT_Get_Paint_Layers(face_, &iterator, &paint))
            draw(paint, place, out);
    }

    /// What the paint draws, cut by the outline. A single fill needs no clip.
    void outline(const FT_PaintGlyph& paint, const Place& place, NodeList& out) {
        ++outlines_;
        const auto path = source_.outlines.outlineOf(paint.glyphID);
        if (!path)
            return;
        const Place inner{path, place.transform, place.transform};
        const int before = outlines_;
        NodeList nodes;
        draw(paint.paint, inner, nodes);
        if (outlines_ != before)
            out.push_back({clipped(std::move(nodes), inner)});
        else
            std::move(nodes.begin(), nodes.end(), std::back_inserter(out));
    }

    void composite(const FT_PaintComposite& paint, const Place& place, NodeList& out) {
        NodeList source, backdrop;
        draw(paint.source_paint, place, source);
        draw(paint.backdrop_paint, place, backdrop);
        const Place all = whole(source_.transform);
        NodeList nodes = composited(paint.composite_mode, std::move(source), std::move(backdrop),
                                    filled(all.path, all.pathTransform, scene::Color{}));
        std::move(nodes.begin(), nodes.end(), std::back_inserter(out));
    }

    scene::Color colorOf(const FT_ColorIndex& index) const {
        constexpr double one = 1 << 14;
        return source_.color(index.palette_index, index.alpha / one);
    }

    /// Nothing for a line without stops.
    std::optional<ColorLine> lineOf(FT_ColorLine& line) {
        constexpr double one = 1 << 14;
        ColorLine made;
        FT_ColorStop stop;
        while (FT_Get_Colorline_Stops(face_, &stop, &line.color_stop_iterator))
            made.stops.push_back({stop.stop_offset / one, colorOf(stop.color)});
        visits_ += int(made.stops.size());
        std::stable_sort(made.stops.begin(), made.stops.end(),
                         [](const auto& a, const auto& b) { return a.offset < b.offset; });
        made.spread = spreadOf(line.extend);
        return made.stops.empty() ? std::nullopt : std::optional(std::move(made));
    }

    /// From the paint's space to that of the place's path.
    static std::optional<Affine> toPath(const Place& place) {
        const auto back = scene::inverse(place.pathTransform);
        return back ? std::optional(scene::compose(*back, place.transform)) : std::nullopt;
    }

    void fill(scene::Paint paint, const Place& place, NodeList& out) {
        const auto transform = toPath(place);
        if (!transform)
            return;
        if (auto* gradient = std::get_if<scene::LinearGradient>(&paint))
            gradient->transform = *transform;
        if (auto* gradient = std::get_if<scene::RadialGradient>(&paint))
            gradient->transform = *transform;
        out.push_back({filled(place.path, place.pathTransform, std::move(paint))});
    }

    /// Pieces in the paint's space.
    void fill(const std::vector<Piece>& pieces, const Place& place, NodeList& out) {
        NodeList nodes;
        for (const Piece& piece : pieces)
            nodes.push_back(
                {filled(std::make_shared<const scene::Path>(piece.path), place.transform, piece.color)});
        out.push_back({clipped(std::move(nodes), place)});
    }

    std::optional<Extent> extent(const Place& place) const {
        const auto path = toPath(place);
        const auto back = path ? scene::inverse(*path) : std::nullopt;
        return back ? std::optional(extentOf(*place.path, *back)) : std::nullopt;
    }

    void linear(FT_PaintLinearGradient& p, const Place& place, NodeList& out) {
        const auto line = lineOf(p.colorline);
        if (!line)
            return;
        if (auto paint = linearGradient(*line, point(p.p0), point(p.p1), point(p.p2)))
            fill(std::move(*paint), place, out);
    }

    void radial(FT_PaintRadialGradient& p, const Place& place, NodeList& out) {
        const auto line = lineOf(p.colorline);
        if (!line)
            return;
        const Circle first{point(p.c0), number(p.r0)}, second{point(p.c1), number(p.r1)};
        const auto around = extent(place);
        if (auto paint = radialGradient(*line, first, second))
            fill(std::move(*paint), place, out);
        else if (around)
            fill(coneGradient(*line, first, second, *around), place, out);
    }

    void sweep(FT_PaintSweepGradient& p, const Place& place, NodeList& out) {
        const auto line = lineOf(p.colorline);
        const auto around = extent(place);
        // OpenType 1.9.1: angles are stored less half a turn, counterclockwise.
        const auto degrees = [](FT_Fixed value) { return 360 - 180 * (number(value) + 1); };
        if (line && around)
            fill(sweepGradient(*line, point(p.center), degrees(p.start_angle), degrees(p.end_angle), *around),
                 place, out);
    }

    const ColorSource& source_;
    FT_Face face_;
    int visits_ = 0, depth_ = 0;
    int outlines_ = 0;  ///< glyphs seen so far
};

}  // namespace

std::optional<scene::Group> paintsOf(const ColorSource& source, FreeTypeFace& face, GlyphId glyph) {
    const std::lock_guard lock(face.mutex);
    Painter painter(source, face.face());
    scene::Group group;
    if (!painter.glyph(glyph, source.transform, group.children) || painter.isExhausted())
        return std::nullopt;
    return group;
}

}  // namespace vtm::text

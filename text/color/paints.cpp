#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "text/color/color_glyph.hpp"
#include "text/color/colr_table.hpp"
#include "text/color/composite.hpp"
#include "text/color/gradients.hpp"
#include "text/fonts/handles.hpp"

namespace vtm::text {
namespace {

using scene::Affine;
using scene::NodeList;
using scene::Point;

constexpr double halfTurn = std::numbers::pi;

/// Fonts' matrices, turned y down.
Affine affine(double xx, double yx, double xy, double yy, double dx, double dy) {
    return {xx, -yx, -xy, yy, dx, -dy};
}

Affine around(const Affine& linear, Point center) {
    return scene::compose(scene::compose(scene::translation(center.x, center.y), linear),
                          scene::translation(-center.x, -center.y));
}

Affine readAffine(TableCursor from) {
    const double xx = from.fixed(), yx = from.fixed(), xy = from.fixed(), yy = from.fixed();
    const double dx = from.fixed(), dy = from.fixed();
    return affine(xx, yx, xy, yy, dx, dy);
}

Affine readScale(TableCursor& from, bool isUniform) {
    const double x = from.fraction(), y = isUniform ? x : from.fraction();
    return scene::scaling(x, y);
}

Affine readRotation(TableCursor& from) {
    const double angle = from.fraction() * halfTurn, c = std::cos(angle), s = std::sin(angle);
    return affine(c, s, -s, c, 0, 0);
}

Affine readSkew(TableCursor& from) {
    const double x = std::tan(from.fraction() * halfTurn), y = std::tan(from.fraction() * halfTurn);
    return affine(1, y, -x, 1, 0, 0);
}

scene::Spread spreadOf(std::uint32_t extend) {
    if (extend == 1)
        return scene::Spread::Repeat;
    return extend == 2 ? scene::Spread::Reflect : scene::Spread::Pad;
}

/// What a paint without an outline of its own fills.
struct Place {
    std::shared_ptr<const scene::Path> path;
    Affine pathTransform;  ///< the path's space to the picture
    Affine transform;      ///< the paint's space to the picture
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

void append(NodeList& to, NodeList nodes) { std::move(nodes.begin(), nodes.end(), std::back_inserter(to)); }

/// As COLR numbers them; the variable format of most is the next number.
enum Format {
    colrLayers = 1,
    solid = 2,
    linearGradientPaint = 4,
    radialGradientPaint = 6,
    sweepGradientPaint = 8,
    glyphPaint = 10,
    colrGlyph = 11,
    transform = 12,
    translate = 14,
    scale = 16,
    scaleAround = 18,
    scaleUniform = 20,
    scaleUniformAround = 22,
    rotate = 24,
    rotateAround = 26,
    skew = 28,
    skewAround = 30,
    composite = 32
};

Format plainFormat(std::uint32_t format) {
    const bool isVariable = format % 2 == 1 && format != colrLayers && format != colrGlyph;
    return static_cast<Format>(isVariable ? format - 1 : format);
}

/// Walks the graph of a glyph's paints. Parts may be shared many times over: the number of visits is bounded.
class Painter {
public:
    Painter(const ColorSource& source, std::span<const std::uint8_t> table)
        : source_(source), table_(table) {}

    /// False where the glyph has no paints.
    bool drawGlyph(GlyphId id, const Affine& toPicture, NodeList& out) {
        const auto paint = table_.paintOf(id);
        if (!paint)
            return false;
        Place place = everywhere(toPicture);
        const auto box = table_.clipBoxOf(id);
        if (box)
            place.path = std::make_shared<const scene::Path>(scene::rectangle(box->min, box->max));
        NodeList nodes;
        draw(*paint, place, nodes);
        if (box)
            out.push_back({clipped(std::move(nodes), place)});
        else
            append(out, std::move(nodes));
        return true;
    }

    bool isExhausted() const { return visits_ > maxColorPaints; }

private:
    static constexpr int maxDepth = 64;

    /// All that a glyph may cover: fonts must bound their paints, and transforms may move outlines.
    Place everywhere(const Affine& toPicture) const {
        constexpr double ems = 16;
        const double side = ems * source_.outlines.unitsPerEm();
        return {std::make_shared<const scene::Path>(scene::rectangle(Point(-side), Point(side))), toPicture,
                toPicture};
    }

    void draw(std::size_t paint, const Place& place, NodeList& out) {
        if (++visits_ > maxColorPaints || depth_ >= maxDepth)
            return;
        ++depth_;
        TableCursor from = table_.at(paint);
        const std::uint32_t format = from.unsignedNumber(1);
        drawPaint({paint, format, from}, place, out);
        --depth_;
    }

    struct Paint {
        std::size_t at;
        std::uint32_t format;
        TableCursor from;  ///< after the format

        std::size_t offset() { return at + from.unsignedNumber(3); }
    };

    void drawPaint(Paint paint, const Place& place, NodeList& out) {
        switch (plainFormat(paint.format)) {
            case colrLayers:
                return drawLayers(paint.from, place, out);
            case solid:
                return fill(readColor(paint.from), place, out);
            case linearGradientPaint:
                return drawLinear(paint, place, out);
            case radialGradientPaint:
                return drawRadial(paint, place, out);
            case sweepGradientPaint:
                return drawSweep(paint, place, out);
            case glyphPaint:
                return drawOutline(paint, place, out);
            case colrGlyph:
                ++outlines_;
                drawGlyph(paint.from.unsignedNumber(2), place.transform, out);
                return;
            case composite:
                return drawComposite(paint, place, out);
            default:
                return drawTransformed(paint, place, out);
        }
    }

    void drawTransformed(Paint paint, Place place, NodeList& out) {
        const std::size_t child = paint.offset();
        if (const auto by = readTransform(paint)) {
            place.transform = scene::compose(place.transform, *by);
            draw(child, place, out);
        }
    }

    /// Nothing for formats of later versions.
    std::optional<Affine> readTransform(Paint& paint) const {
        TableCursor& from = paint.from;
        switch (plainFormat(paint.format)) {
            case transform:
                return readAffine(table_.at(paint.offset()));
            case translate: {
                const Point by = from.point();
                return scene::translation(by.x, by.y);
            }
            case scale:
            case scaleUniform:
                return readScale(from, paint.format >= scaleUniform);
            case scaleAround:
            case scaleUniformAround: {
                const Affine linear = readScale(from, paint.format >= scaleUniform);
                return around(linear, from.point());
            }
            case rotate:
                return readRotation(from);
            case rotateAround: {
                const Affine linear = readRotation(from);
                return around(linear, from.point());
            }
            case skew:
                return readSkew(from);
            case skewAround: {
                const Affine linear = readSkew(from);
                return around(linear, from.point());
            }
            default:
                return std::nullopt;
        }
    }

    void drawLayers(TableCursor from, const Place& place, NodeList& out) {
        const std::uint32_t count = from.unsignedNumber(1), first = from.unsignedNumber(4);
        for (std::uint32_t i = 0; i < count && !isExhausted(); ++i)
            if (const auto paint = table_.layer(first + i))
                draw(*paint, place, out);
    }

    /// What the child draws, cut by the outline. A single fill needs no clip.
    void drawOutline(Paint paint, const Place& place, NodeList& out) {
        const std::size_t child = paint.offset();
        const auto path = source_.outlines.outlineOf(paint.from.unsignedNumber(2));
        const int before = ++outlines_;
        if (!path)
            return;
        const Place inner{path, place.transform, place.transform};
        NodeList nodes;
        draw(child, inner, nodes);
        if (outlines_ != before)
            out.push_back({clipped(std::move(nodes), inner)});
        else
            append(out, std::move(nodes));
    }

    void drawComposite(Paint paint, const Place& place, NodeList& out) {
        const std::size_t above = paint.offset();
        const auto mode = static_cast<CompositeMode>(paint.from.unsignedNumber(1));
        const std::size_t below = paint.offset();
        NodeList source, backdrop;
        draw(above, place, source);
        draw(below, place, backdrop);
        const Place all = everywhere(source_.transform);
        append(out, composited(mode, std::move(source), std::move(backdrop),
                               filled(all.path, all.pathTransform, scene::Color{})));
    }

    scene::Color readColor(TableCursor& from) const {
        const std::uint32_t index = from.unsignedNumber(2);
        return source_.color(index, from.fraction());
    }

    /// Nothing for a line without stops.
    std::optional<ColorLine> readLine(Paint& paint) {
        TableCursor from = table_.at(paint.offset());
        const bool isVariable = paint.format % 2 == 1;
        ColorLine line;
        line.spread = spreadOf(from.unsignedNumber(1));
        const std::uint32_t count = from.unsignedNumber(2);
        for (visits_ += int(count); line.stops.size() < count && !isExhausted();) {
            const double offset = from.fraction();
            line.stops.push_back({offset, readColor(from)});
            if (isVariable)
                from.unsignedNumber(4);
        }
        std::stable_sort(line.stops.begin(), line.stops.end(),
                         [](const auto& a, const auto& b) { return a.offset < b.offset; });
        return line.stops.empty() ? std::nullopt : std::optional(std::move(line));
    }

    /// From the paint's space to that of the place's path.
    static std::optional<Affine> toPath(const Place& place) {
        const auto back = scene::inverse(place.pathTransform);
        return back ? std::optional(scene::compose(*back, place.transform)) : std::nullopt;
    }

    void fill(scene::Paint paint, const Place& place, NodeList& out) {
        const auto toPathSpace = toPath(place);
        if (!toPathSpace)
            return;
        if (auto* linear = std::get_if<scene::LinearGradient>(&paint))
            linear->transform = *toPathSpace;
        if (auto* radial = std::get_if<scene::RadialGradient>(&paint))
            radial->transform = *toPathSpace;
        out.push_back({filled(place.path, place.pathTransform, std::move(paint))});
    }

    /// Pieces in the paint's space.
    void fill(const std::vector<Piece>& pieces, const Place& place, NodeList& out) {
        visits_ += int(pieces.size()) / 16;  // a piece is less work than a paint
        NodeList nodes;
        for (const Piece& piece : pieces)
            nodes.push_back(
                {filled(std::make_shared<const scene::Path>(piece.path), place.transform, piece.color)});
        out.push_back({clipped(std::move(nodes), place)});
    }

    static std::optional<Extent> extent(const Place& place) {
        const auto path = toPath(place);
        const auto back = path ? scene::inverse(*path) : std::nullopt;
        return back ? std::optional(extentOf(*place.path, *back)) : std::nullopt;
    }

    void drawLinear(Paint paint, const Place& place, NodeList& out) {
        const auto line = readLine(paint);
        const Point p0 = paint.from.point(), p1 = paint.from.point(), p2 = paint.from.point();
        if (auto gradient = line ? linearGradient(*line, p0, p1, p2) : std::nullopt)
            fill(std::move(*gradient), place, out);
    }

    static Circle readCircle(TableCursor& from) {
        const Point center = from.point();
        return {center, double(from.unsignedNumber(2))};
    }

    void drawRadial(Paint paint, const Place& place, NodeList& out) {
        const auto line = readLine(paint);
        const Circle first = readCircle(paint.from), second = readCircle(paint.from);
        const auto covered = extent(place);
        if (!line || !covered)
            return;
        if (auto gradient = radialGradient(*line, first, second))
            fill(std::move(*gradient), place, out);
        else
            fill(coneGradient(*line, first, second, *covered), place, out);
    }

    void drawSweep(Paint paint, const Place& place, NodeList& out) {
        const auto line = readLine(paint);
        const Point center = paint.from.point();
        // Stored less half a turn, counterclockwise.
        const auto readAngle = [&] { return 360 - 180 * (paint.from.fraction() + 1); };
        const double start = readAngle(), end = readAngle();
        const auto covered = extent(place);
        if (line && covered)
            fill(sweepGradient(*line, center, start, end, *covered), place, out);
    }

    const ColorSource& source_;
    const ColrTable table_;
    int visits_ = 0, depth_ = 0;
    int outlines_ = 0;  ///< glyphs met so far
};

}  // namespace

std::optional<scene::Group> paintsOf(const ColorSource& source, GlyphId glyph) {
    hb_face_t* const face = hb_font_get_face(source.outlines.harfbuzz());
    const HbBlob table(hb_face_reference_table(face, HB_TAG('C', 'O', 'L', 'R')));
    unsigned size = 0;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(hb_blob_get_data(table.get(), &size));
    Painter painter(source, {bytes, size});
    scene::Group group;
    if (!painter.drawGlyph(glyph, source.transform, group.children) || painter.isExhausted())
        return std::nullopt;
    return group;
}

}  // namespace vtm::text

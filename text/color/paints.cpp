#include <algorithm>
#include <cmath>
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

PaintFormat plainFormat(std::uint32_t format) {
    const auto plain = static_cast<PaintFormat>(format);
    const bool isVariable =
        format % 2 == 1 && plain != PaintFormat::ColrLayers && plain != PaintFormat::ColrGlyph;
    return isVariable ? static_cast<PaintFormat>(format - 1) : plain;
}

/// Walks the graph of a glyph's paints. Parts may be shared many times over: the number of visits is bounded.
class ColorGlyphPainter {
public:
    ColorGlyphPainter(const ColorSource& source, std::span<const std::uint8_t> table)
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
            case PaintFormat::ColrLayers:
                return drawLayers(paint.from, place, out);
            case PaintFormat::Solid:
                return fill(readColor(paint.from), place, out);
            case PaintFormat::LinearGradient:
                return drawLinear(paint, place, out);
            case PaintFormat::RadialGradient:
                return drawRadial(paint, place, out);
            case PaintFormat::SweepGradient:
                return drawSweep(paint, place, out);
            case PaintFormat::Glyph:
                return drawOutline(paint, place, out);
            case PaintFormat::ColrGlyph:
                ++outlines_;
                drawGlyph(paint.from.unsignedNumber(2), place.transform, out);
                return;
            case PaintFormat::Composite:
                return drawComposite(paint, place, out);
            default:
                return drawTransformed(paint, place, out);
        }
    }

    void drawTransformed(Paint paint, Place place, NodeList& out) {
        const std::size_t child = paint.offset();
        if (const auto by = readTransform(table_, plainFormat(paint.format), paint.at, paint.from)) {
            place.transform = scene::compose(place.transform, *by);
            draw(child, place, out);
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
    void fill(const std::vector<ColoredPath>& pieces, const Place& place, NodeList& out) {
        visits_ += int(pieces.size()) / 16;  // a piece is less work than a paint
        NodeList nodes;
        for (const ColoredPath& piece : pieces)
            nodes.push_back(
                {filled(std::make_shared<const scene::Path>(piece.path), place.transform, piece.color)});
        out.push_back({clipped(std::move(nodes), place)});
    }

    static std::optional<Extent> extent(const Place& place) {
        const auto path = toPath(place);
        const auto back = path ? scene::inverse(*path) : std::nullopt;
        return back ? std::optional(boundsOf(*place.path, *back)) : std::nullopt;
    }

    void drawLinear(Paint paint, const Place& place, NodeList& out) {
        const auto line = readLine(paint);
        const Point p0 = readPoint(paint.from), p1 = readPoint(paint.from), p2 = readPoint(paint.from);
        if (auto gradient = line ? linearGradient(*line, p0, p1, p2) : std::nullopt)
            fill(std::move(*gradient), place, out);
    }

    static Circle readCircle(TableCursor& from) {
        const Point center = readPoint(from);
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
        const Point center = readPoint(paint.from);
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
    ColorGlyphPainter painter(source, bytesOf(table.get()));
    scene::Group group;
    if (!painter.drawGlyph(glyph, source.transform, group.children) || painter.isExhausted())
        return std::nullopt;
    return group;
}

}  // namespace vtm::text

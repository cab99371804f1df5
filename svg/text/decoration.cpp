#include "svg/text/decoration.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "svg/geometry/path_geometry.hpp"

namespace vtm::svg {
namespace {

/// The part of a line along one cluster.
struct Segment {
    scene::Affine frame;  ///< from the start of the line's baseline there
    double length;
};

/// Of a segment: thinner dashes and dots than that end before it.
constexpr double maxDashes = 10000;

struct Bar {
    double top, bottom;  ///< below the decorating element's baseline
};

double resolved(const Length& length, const ElementFont& font) { return length.of(font.size); }

/// Below the baseline. In vertical text the underline is at the letters' edge, `under left` (CSS Text
/// Decoration 4 section 2.8.1).
double middleOf(TextLines line, const TextElement& element, const ElementFont& font, bool vertical) {
    const text::FontMetrics& metrics = font.primary->metrics();
    if (line == LineThrough)
        return -font.scaled(metrics.strikeoutOffset);
    if (line == Overline)
        return -font.ascent();
    const auto& offset = element.scope.style.underlineOffset;
    if (vertical)
        return font.descent() + (offset ? resolved(*offset, font) : 0);
    return offset ? resolved(*offset, font) : font.scaled(metrics.underlineOffset);
}

double thicknessOf(TextLines line, const TextElement& element, const ElementFont& font) {
    const text::FontMetrics& metrics = font.primary->metrics();
    if (element.decoration.thickness)
        return resolved(*element.decoration.thickness, font);
    return font.scaled(line == LineThrough ? metrics.strikeoutThickness : metrics.underlineThickness);
}

/// The second line of double ones is away from the text, one line free between them; those through the text
/// are on both sides of the middle.
std::vector<Bar> barsOf(TextLines line, const TextElement& element, const ElementFont& font, bool vertical) {
    if (!font.primary)
        return {};
    const double middle = middleOf(line, element, font, vertical);
    const double half = thicknessOf(line, element, font) / 2;
    const auto at = [&](double y) { return Bar{y - half, y + half}; };
    if (!(half > 0))
        return {};
    if (element.decoration.style != LineStyle::Double)
        return {at(middle)};
    if (line == LineThrough)
        return {at(middle - 2 * half), at(middle + 2 * half)};
    return {at(middle), at(middle + (line == Underline ? 4 : -4) * half)};
}

/// Whether `next` goes on where `before` ends, as near as rounding leaves them.
bool runsOn(const Segment& before, const Segment& next, double size) {
    constexpr double rounding = 1e-6;  // of an em
    const glm::dvec2 end = scene::apply(before.frame, {before.length, 0});
    return glm::distance(end, next.frame[2]) <= rounding * size &&
           glm::distance(before.frame[0], next.frame[0]) <= rounding &&
           glm::distance(before.frame[1], next.frame[1]) <= rounding;
}

/// Segments that run on from each other are one.
std::vector<Segment> joined(const std::vector<Segment>& segments, double size) {
    std::vector<Segment> made;
    for (const Segment& segment : segments)
        if (!made.empty() && runsOn(made.back(), segment, size))
            made.back().length += segment.length;
        else
            made.push_back(segment);
    return made;
}

void addRectangle(const scene::Affine& frame, double from, double to, Bar bar, scene::Path& out) {
    std::vector<scene::Point> corners;
    for (const scene::Point corner : {scene::Point(from, bar.top), scene::Point(to, bar.top),
                                      scene::Point(to, bar.bottom), scene::Point(from, bar.bottom)})
        corners.push_back(scene::apply(frame, corner));
    const scene::Path rectangle = scene::polygon(corners);
    out.insert(out.end(), rectangle.begin(), rectangle.end());
}

/// Of the bar's thickness, one behind the other with as much between them as is left of the period.
void addDashes(const Segment& segment, Bar bar, scene::Path& out) {
    constexpr double dash = 3, period = 5;  // of the thickness
    const double thickness = bar.bottom - bar.top;
    const auto count = std::min(std::ceil(segment.length / (period * thickness)), maxDashes);
    for (double i = 0; i < count; ++i) {
        const double from = i * period * thickness;
        addRectangle(segment.frame, from, std::min(from + dash * thickness, segment.length), bar, out);
    }
}

/// Round, a diameter between them.
void addDots(const Segment& segment, Bar bar, scene::Path& out) {
    const double radius = (bar.bottom - bar.top) / 2, middle = bar.top + radius;
    const auto count = std::min(std::floor((segment.length / radius + 2) / 4), maxDashes);
    for (double i = 0; i < count; ++i) {
        const double left = i * 4 * radius;
        const scene::Path circle{scene::MoveTo{{left, middle}},
                                 scene::ArcTo{{radius, radius}, 0, false, true, {left + 2 * radius, middle}},
                                 scene::ArcTo{{radius, radius}, 0, false, true, {left, middle}},
                                 scene::Close{}};
        const scene::Path placed = mapPath(segment.frame, circle);
        out.insert(out.end(), placed.begin(), placed.end());
    }
}

scene::Path outlineOf(const Segment& segment, Bar bar, LineStyle style) {
    scene::Path made;
    if (style == LineStyle::Dashed)
        addDashes(segment, bar, made);
    else if (style == LineStyle::Dotted)
        addDots(segment, bar, made);
    else
        addRectangle(segment.frame, 0, segment.length, bar, made);
    return made;
}

class LineMaker {
public:
    LineMaker(const TextContent& content, const std::vector<ElementFont>& fonts,
              const std::vector<PlacedCluster>& clusters, bool vertical)
        : content_(content), fonts_(fonts), vertical_(vertical), segments_(content.elements.size()) {
        for (const PlacedCluster& cluster : clusters)
            addSegments(cluster);
    }

    /// The lines of one element on the clusters in it.
    void add(std::size_t element) {
        const unsigned lines = content_.elements[element].lines;
        if (lines == 0)
            return;
        const TextElement& text = content_.elements[element];
        const std::vector<Segment> segments = joined(segments_[element], fonts_[element].size);
        for (const TextLines line : {Underline, Overline, LineThrough})
            for (const Bar bar : barsOf(line, text, fonts_[element], vertical_))
                for (const Segment& segment : segments)
                    if ((lines & line) && segment.length > 0)
                        made_.push_back({element, line, outlineOf(segment, bar, text.decoration.style)});
    }

    std::vector<PlacedLine> finish() { return std::move(made_); }

private:
    /// Along the cluster, for each decorated element around it. Subscripts and superscripts in an element do
    /// not move its lines, their alignment does.
    void addSegments(const PlacedCluster& cluster) {
        const double shift = fonts_[static_cast<std::size_t>(cluster.element)].shift;
        for (int element = cluster.element; element >= 0;) {
            const auto index = static_cast<std::size_t>(element);
            const ElementFont& font = fonts_[index];
            const double down = font.shift - shift + (vertical_ ? font.central() : 0);
            if (content_.elements[index].lines != 0)
                segments_[index].push_back(
                    {scene::compose(cluster.frame, scene::translation(0, down)), cluster.cell.max.x});
            element = content_.elements[index].parent;
        }
    }

    const TextContent& content_;
    const std::vector<ElementFont>& fonts_;
    const bool vertical_;
    std::vector<std::vector<Segment>> segments_;  ///< by element
    std::vector<PlacedLine> made_;
};

}  // namespace

std::vector<PlacedLine> decorationLines(const TextContent& content, const std::vector<ElementFont>& fonts,
                                        const std::vector<PlacedCluster>& clusters, bool vertical) {
    LineMaker maker(content, fonts, clusters, vertical);
    for (std::size_t i = 0; i < content.elements.size(); ++i)
        maker.add(i);
    return maker.finish();
}

}  // namespace vtm::svg

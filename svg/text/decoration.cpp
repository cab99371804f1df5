#include "svg/text/decoration.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace vtm::svg {
namespace {

/// The part of a line along one cluster.
struct Segment {
    scene::Affine frame;  ///< from the start of the line's baseline there
    double length;
};

struct Bar {
    double top, bottom;  ///< below the decorating element's baseline
};

/// In vertical text the underline is at the letters' edge, `under left` (CSS Text Decoration 4
/// section 2.8.1).
Bar barOf(TextLines line, const ElementFont& font, bool vertical) {
    if (!font.primary)
        return {0, 0};
    const text::FontMetrics& metrics = font.primary->metrics();
    double middle = vertical ? font.descent() : font.scaled(metrics.underlineOffset);
    double thickness = font.scaled(metrics.underlineThickness);
    if (line == LineThrough) {
        middle = -font.scaled(metrics.strikeoutOffset);
        thickness = font.scaled(metrics.strikeoutThickness);
    } else if (line == Overline) {
        middle = -font.ascent();
    }
    return {middle - thickness / 2, middle + thickness / 2};
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

scene::Path rectangleIn(const scene::Affine& frame, double length, Bar bar) {
    std::vector<scene::Point> corners;
    for (const scene::Point corner : {scene::Point(0, bar.top), scene::Point(length, bar.top),
                                      scene::Point(length, bar.bottom), scene::Point(0, bar.bottom)})
        corners.push_back(scene::apply(frame, corner));
    return scene::polygon(corners);
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
        const ElementFont& font = fonts_[element];
        const std::vector<Segment> segments = joined(segments_[element], font.size);
        for (const TextLines line : {Underline, Overline, LineThrough}) {
            const Bar bar = barOf(line, font, vertical_);
            for (const Segment& segment : segments)
                if ((lines & line) && segment.length > 0 && bar.bottom > bar.top)
                    made_.push_back({element, line, rectangleIn(segment.frame, segment.length, bar)});
        }
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

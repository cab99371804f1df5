#include "svg/text/decoration.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace vtm::svg {
namespace {

/// Clusters whose frames run on from each other, with one line through all of them.
struct Stretch {
    std::size_t first, end;  ///< clusters
    double length;           ///< from the first one's pen
};

struct Bar {
    double top, bottom;  ///< below the decorating element's baseline
};

Bar barOf(TextLines line, const ElementFont& font) {
    if (!font.primary)
        return {0, 0};
    const text::FontMetrics& metrics = font.primary->metrics();
    double middle = font.scaled(metrics.underlineOffset), thickness = font.scaled(metrics.underlineThickness);
    if (line == LineThrough) {
        middle = -font.scaled(metrics.strikeoutOffset);
        thickness = font.scaled(metrics.strikeoutThickness);
    } else if (line == Overline) {
        middle = -font.ascent() + thickness / 2;
    }
    return {middle - thickness / 2, middle + thickness / 2};
}

/// Ends that are as near as rounding leaves them.
bool runsOn(const PlacedCluster& before, double length, const PlacedCluster& cluster, double size) {
    constexpr double rounding = 1e-6;  // of an em
    const glm::dvec2 end = scene::apply(before.frame, {length, 0});
    return glm::distance(end, cluster.frame[2]) <= rounding * size &&
           glm::distance(before.frame[0], cluster.frame[0]) <= rounding &&
           glm::distance(before.frame[1], cluster.frame[1]) <= rounding;
}

std::vector<Stretch> stretches(const std::vector<PlacedCluster>& clusters, const std::vector<bool>& wanted,
                               double size) {
    std::vector<Stretch> found;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        if (!wanted[i])
            continue;
        const double width = clusters[i].cell.max.x;
        const bool goesOn = !found.empty() && found.back().end == i &&
                            runsOn(clusters[found.back().first], found.back().length, clusters[i], size);
        if (goesOn) {
            found.back().end = i + 1;
            found.back().length += width;
        } else {
            found.push_back({i, i + 1, width});
        }
    }
    return found;
}

scene::Path rectangleIn(const scene::Affine& frame, double length, Bar bar) {
    std::vector<scene::Point> corners;
    for (const scene::Point corner : {scene::Point(0, bar.top), scene::Point(length, bar.top),
                                      scene::Point(length, bar.bottom), scene::Point(0, bar.bottom)})
        corners.push_back(scene::apply(frame, corner));
    return scene::polygon(corners);
}

/// Whether the decorations of `ancestor` reach the element: it is around it.
bool isAround(const TextContent& content, std::size_t ancestor, int element) {
    while (element >= 0 && static_cast<std::size_t>(element) != ancestor)
        element = content.elements[static_cast<std::size_t>(element)].parent;
    return element >= 0;
}

}  // namespace

std::vector<PlacedLine> decorationLines(const TextContent& content, const std::vector<ElementFont>& fonts,
                                        const std::vector<PlacedCluster>& clusters, bool vertical) {
    std::vector<PlacedLine> lines;
    for (std::size_t element = 0; element < content.elements.size(); ++element) {
        const Style& style = content.elements[element].scope.style;
        if (style.textLines == 0)
            continue;
        std::vector<bool> wanted;
        for (const PlacedCluster& cluster : clusters)
            wanted.push_back(isAround(content, element, cluster.element));
        const ElementFont& font = fonts[element];
        const double baseline = font.baseline + (vertical ? font.central() : 0);
        for (const TextLines line : {Underline, Overline, LineThrough}) {
            if (!(style.textLines & line))
                continue;
            Bar bar = barOf(line, font);
            bar = {bar.top + baseline, bar.bottom + baseline};
            for (const Stretch& stretch : stretches(clusters, wanted, font.size))
                if (stretch.length > 0 && bar.bottom > bar.top)
                    lines.push_back({static_cast<int>(element), line, stretch.first,
                                     rectangleIn(clusters[stretch.first].frame, stretch.length, bar)});
        }
    }
    return lines;
}

}  // namespace vtm::svg
